//! The paths that a file mentions: in `use` items, and inline in code and macro calls.

use quote::ToTokens;
use syn::{Item, UseTree, Visibility};

use crate::syntax::{Token, tokens};

/// A path such as `crate::mode::Mode`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedPath {
    /// Segments: `["crate", "mode", "Mode"]`; a glob import ends in `*`.
    pub segments: Vec<String>,
    /// Line number, from 1.
    pub line: usize,
}

/// One name imported by a `use` item.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Import {
    /// Path of the imported item.
    pub path: NamedPath,
    /// Name in the importing module: the last segment unless renamed with `as`.
    pub name: String,
    /// Whether the import is a re-export (`pub use` or `pub(crate) use`).
    pub is_public: bool,
}

/// The imports among `items`, without those of nested modules.
pub fn imports(items: &[Item]) -> Vec<Import> {
    let mut imports = Vec::new();
    for item in items {
        if let Item::Use(item) = item {
            let is_public = !matches!(item.vis, Visibility::Inherited);
            let mut prefix = if item.leading_colon.is_some() { vec!["".to_owned()] } else { Vec::new() };
            collect(&item.tree, &mut prefix, is_public, &mut imports);
        }
    }
    imports
}

fn collect(tree: &UseTree, prefix: &mut Vec<String>, is_public: bool, into: &mut Vec<Import>) {
    let mut import = |segment: String, name: String, line: usize| {
        let mut segments = prefix.clone();
        // `use a::b::{self, C}` imports `a::b`.
        if segment != "self" || segments.is_empty() {
            segments.push(segment);
        }
        let name = if name == "self" { segments.last().cloned().unwrap_or_default() } else { name };
        into.push(Import { path: NamedPath { segments, line }, name, is_public });
    };
    match tree {
        UseTree::Path(path) => {
            prefix.push(path.ident.to_string());
            collect(&path.tree, prefix, is_public, into);
            prefix.pop();
        }
        UseTree::Group(group) => group.items.iter().for_each(|tree| collect(tree, prefix, is_public, into)),
        UseTree::Name(name) => import(name.ident.to_string(), name.ident.to_string(), name.ident.span().start().line),
        UseTree::Rename(rename) => {
            import(rename.ident.to_string(), rename.rename.to_string(), rename.ident.span().start().line);
        }
        UseTree::Glob(glob) => import("*".to_owned(), "*".to_owned(), glob.star_token.spans[0].start().line),
    }
}

/// Tokens of all `items` except imports.
pub fn body_tokens(items: &[Item]) -> Vec<Token> {
    items.iter().filter(|item| !matches!(item, Item::Use(_))).flat_map(|item| tokens(item.to_token_stream())).collect()
}

/// Paths of at least two segments in `tokens`, including those within macro calls.
pub fn inline_paths(tokens: &[Token]) -> Vec<NamedPath> {
    let is_name = |token: &Token| token.text.starts_with(|first: char| first.is_alphabetic() || first == '_');
    let mut paths = Vec::new();
    let mut index = 0;
    while index < tokens.len() {
        let begin = index;
        index += 1;
        // After `::` comes the rest of a path that does not begin with a name: `<T as Trait>::NAME`.
        if !is_name(&tokens[begin]) || begin > 0 && tokens[begin - 1].text == "::" {
            continue;
        }
        let mut segments = vec![tokens[begin].text.clone()];
        while index + 1 < tokens.len() && tokens[index].text == "::" && is_name(&tokens[index + 1]) {
            segments.push(tokens[index + 1].text.clone());
            index += 2;
        }
        if segments.len() > 1 {
            paths.push(NamedPath { segments, line: tokens[begin].line });
        }
    }
    paths
}
