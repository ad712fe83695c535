//! Parsing for the checks: files with or without test code, and tokens with line numbers.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use syn::{Attribute, File, ImplItem, Item};

/// A token: an identifier, a literal, or punctuation (`::`, `=>` and `->` in one piece).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    /// The token as written.
    pub text: String,
    /// Line number, from 1.
    pub line: usize,
}

/// Parses a file.
///
/// # Panics
/// If the text is not valid Rust.
pub fn parse(file: &str, text: &str) -> File {
    syn::parse_file(text).unwrap_or_else(|error| panic!("{file}:{}: {error}", error.span().start().line))
}

/// Parses a file and removes test code.
///
/// # Panics
/// If it is no Rust.
pub fn parse_without_tests(file: &str, text: &str) -> File {
    let mut parsed = parse(file, text);
    parsed.items = without_tests(parsed.items);
    parsed
}

fn without_tests(items: Vec<Item>) -> Vec<Item> {
    let mut kept: Vec<Item> = items.into_iter().filter(|item| !is_for_tests(attributes(item))).collect();
    for item in &mut kept {
        match item {
            Item::Mod(module) => {
                if let Some((_, content)) = &mut module.content {
                    *content = without_tests(std::mem::take(content));
                }
            }
            Item::Impl(block) => block.items.retain(|item| !matches!(item, ImplItem::Fn(f) if is_for_tests(&f.attrs))),
            _ => {}
        }
    }
    kept
}

/// Whether the attributes contain `#[cfg(test)]` or `#[test]`.
fn is_for_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        syn::Meta::List(list) => list.path.is_ident("cfg") && list.tokens.to_string() == "test",
        meta => meta.path().is_ident("test"),
    })
}

/// Attributes of an item, including documentation.
pub fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Union(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

/// The documentation among `attributes`, line by line.
pub fn documentation(attributes: &[Attribute]) -> String {
    let line = |attribute: &Attribute| match &attribute.meta {
        syn::Meta::NameValue(meta) if meta.path.is_ident("doc") => match &meta.value {
            syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) => Some(text.value()),
            _ => None,
        },
        _ => None,
    };
    attributes.iter().filter_map(line).collect::<Vec<_>>().join("\n")
}

/// All tokens of `stream` in order, including the brackets of groups.
pub fn tokens(stream: TokenStream) -> Vec<Token> {
    let mut tokens = Vec::new();
    flatten(stream, &mut tokens);
    tokens
}

fn flatten(stream: TokenStream, into: &mut Vec<Token>) {
    let mut is_joint = false;
    for tree in stream {
        let line = tree.span().start().line;
        match tree {
            TokenTree::Group(group) => {
                let (open, close) = match group.delimiter() {
                    Delimiter::Parenthesis => ("(", ")"),
                    Delimiter::Brace => ("{", "}"),
                    Delimiter::Bracket => ("[", "]"),
                    Delimiter::None => ("", ""),
                };
                into.push(Token { text: open.to_owned(), line });
                flatten(group.stream(), into);
                into.push(Token { text: close.to_owned(), line: group.span_close().start().line });
                is_joint = false;
            }
            TokenTree::Punct(punct) => match into.last_mut() {
                Some(last) if is_joint && ["::", "=>", "->"].contains(&&*format!("{}{punct}", last.text)) => {
                    last.text.push(punct.as_char());
                    is_joint = false;
                }
                _ => {
                    into.push(Token { text: punct.to_string(), line });
                    is_joint = punct.spacing() == proc_macro2::Spacing::Joint;
                }
            },
            TokenTree::Ident(ident) => {
                into.push(Token { text: ident.to_string(), line });
                is_joint = false;
            }
            TokenTree::Literal(literal) => {
                into.push(Token { text: literal.to_string(), line });
                is_joint = false;
            }
        }
    }
}
