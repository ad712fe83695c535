//! What a check finds.

/// The result of one check.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Name of the check.
    pub check: &'static str,
    /// What was measured, in words and numbers.
    pub figure: String,
    /// What is wrong, if anything is.
    pub wrong: Option<String>,
    /// What to change, the likeliest first; each mends it by itself unless the text says otherwise.
    pub remedies: Vec<Remedy>,
}

/// A key to turn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remedy {
    /// Name of the file in the configuration folder.
    pub file: &'static str,
    /// Key with its table.
    pub key: String,
    /// What to set it to, or how to change it, and why.
    pub advice: String,
}

impl Finding {
    /// Nothing is wrong.
    pub fn good(check: &'static str, figure: String) -> Self {
        Self { check, figure, wrong: None, remedies: Vec::new() }
    }

    /// Something is wrong.
    pub fn bad(check: &'static str, figure: String, wrong: String, remedies: Vec<Remedy>) -> Self {
        Self { check, figure, wrong: Some(wrong), remedies }
    }
}

impl Remedy {
    /// The file and the key in it.
    pub fn place(&self) -> String {
        format!("{}:{}", self.file, self.key)
    }
}
