//! Enums that travel as a `u32`: an invalid enum in shared memory would be undefined behaviour, an unknown number is
//! not.

/// An enum with a number for each variant.
pub trait Code: Sized + Copy {
    /// All numbers with their meanings, for error messages.
    const KNOWN: &'static str;

    /// The variant with a number; `None` if there is none.
    fn from_code(code: u32) -> Option<Self>;
}

/// Defines an enum with explicit numbers, its number as `code()`, and its text as `Display`.
macro_rules! codes {
    ($(#[$about:meta])* $name:ident { $($(#[$meaning:meta])* $variant:ident = $code:literal $text:literal,)+ }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[repr(u32)]
        pub enum $name {
            $($(#[$meaning])* $variant = $code,)+
        }

        impl $name {
            /// All variants, in the order of their numbers.
            pub const ALL: &[$name] = &[$($name::$variant),+];

            /// Its number in messages.
            pub const fn code(self) -> u32 {
                self as u32
            }

            /// Its meaning in words.
            pub const fn text(self) -> &'static str {
                match self {
                    $($name::$variant => $text,)+
                }
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, formatter: &mut std::fmt::Formatter) -> std::fmt::Result {
                formatter.pad(self.text())
            }
        }

        impl $crate::code::Code for $name {
            const KNOWN: &'static str = concat!("" $(, stringify!($code), " (", $text, ") ")+);

            fn from_code(code: u32) -> Option<Self> {
                match code {
                    $($code => Some($name::$variant),)+
                    _ => None,
                }
            }
        }
    };
}

pub(crate) use codes;

#[cfg(test)]
mod tests {
    use super::Code;
    use crate::{Fault, Intent, Lifetime, Mode, PushOutcome, Reason, Source, Verdict};

    fn there_and_back<T: Code + PartialEq + std::fmt::Debug>(all: &[T], code: impl Fn(T) -> u32) {
        for &variant in all {
            assert_eq!(T::from_code(code(variant)), Some(variant));
        }
        assert_eq!(T::from_code(u32::MAX), None);
    }

    #[test]
    fn every_code_leads_back_to_its_variant() {
        there_and_back(Intent::ALL, Intent::code);
        there_and_back(Lifetime::ALL, Lifetime::code);
        there_and_back(Source::ALL, Source::code);
        there_and_back(Verdict::ALL, Verdict::code);
        there_and_back(Reason::ALL, Reason::code);
        there_and_back(Mode::ALL, Mode::code);
        there_and_back(Fault::ALL, Fault::code);
        there_and_back(PushOutcome::ALL, PushOutcome::code);
    }
}
