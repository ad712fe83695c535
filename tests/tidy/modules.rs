//! The module tree of a crate: the file, definitions and imports of each module.

use std::collections::{BTreeMap, BTreeSet};

use syn::{File, Item, Lit, Meta};

use crate::paths::{Import, imports};
use crate::sources::Sources;
use crate::syntax::{Token, attributes, parse, parse_without_tests, tokens};

/// Longest chain of re-exports that is followed.
const IMPORTS_MAX: usize = 32;

/// A module of a crate.
pub struct Module {
    /// Path of the file that contains the module.
    pub file: String,
    /// Items of the module, child modules excluded.
    pub items: Vec<Item>,
    /// Names that the module imports.
    pub imports: Vec<Import>,
    defined: BTreeSet<String>,
    children: BTreeMap<String, usize>,
    parent: usize,
}

/// All modules of a crate; the first one is the crate root.
pub struct Modules(pub Vec<Module>);

/// The target of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Found {
    /// An item defined in the module with this index.
    ItemOf(usize),
    /// The module with this index.
    Module(usize),
}

impl Modules {
    /// The modules of the crate with root file `root`, with or without `#[cfg(test)]` code.
    pub fn of_crate(sources: &Sources, root: &str, with_tests: bool) -> Self {
        let mut modules = Self(Vec::new());
        let read = Reader { sources, parse: if with_tests { parse } else { parse_without_tests } };
        modules.add_file(&read, root, folder_of(root), 0);
        modules
    }

    /// All source files of the crate.
    pub fn files(&self) -> BTreeSet<&str> {
        self.0.iter().map(|module| module.file.as_str()).collect()
    }

    /// Follows `path`, as written in module `from`, through all imports to its definition; `None` if that is outside
    /// the crate.
    pub fn resolve(&self, from: usize, path: &[String]) -> Option<Found> {
        self.follow(from, path, IMPORTS_MAX)
    }

    fn follow(&self, from: usize, path: &[String], imports_max: usize) -> Option<Found> {
        let (first, rest) = path.split_first()?;
        let mut found = match first.as_str() {
            "crate" => Found::Module(0),
            "self" => Found::Module(from),
            "super" => Found::Module(self.0[from].parent),
            name => self.look_up(from, name, imports_max)?,
        };
        for name in rest {
            found = match found {
                // Variants and associated items count as part of their type.
                Found::ItemOf(module) => Found::ItemOf(module),
                Found::Module(module) if name == "super" => Found::Module(self.0[module].parent),
                Found::Module(module) if name == "*" => Found::Module(module),
                Found::Module(module) => self.look_up(module, name, imports_max)?,
            };
        }
        Some(found)
    }

    fn look_up(&self, module: usize, name: &str, imports_max: usize) -> Option<Found> {
        let Module { children, defined, imports, .. } = &self.0[module];
        if let Some(child) = children.get(name) {
            return Some(Found::Module(*child));
        }
        if defined.contains(name) {
            return Some(Found::ItemOf(module));
        }
        let imports_max = imports_max.checked_sub(1)?;
        let named = imports.iter().filter(|import| import.name == name && import.path.segments[0] != name);
        let mut named = named.filter_map(|import| self.follow(module, &import.path.segments, imports_max));
        if let Some(found) = named.next() {
            return Some(found);
        }
        let mut globs = imports.iter().filter(|import| import.name == "*");
        globs.find_map(|glob| match self.follow(module, &glob.path.segments, imports_max)? {
            Found::Module(there) if there != module => self.look_up(there, name, imports_max),
            _ => None,
        })
    }

    fn add_file(&mut self, read: &Reader<'_>, file: &str, folder: String, parent: usize) -> usize {
        let Some(text) = read.sources.0.get(file) else { panic!("{file} does not exist") };
        let File { items, .. } = (read.parse)(file, text);
        self.add(read, file, folder, parent, items)
    }

    /// Adds a module; `folder` contains the files of its child modules.
    fn add(&mut self, read: &Reader<'_>, file: &str, folder: String, parent: usize, items: Vec<Item>) -> usize {
        let here = self.0.len();
        self.0.push(Module {
            file: file.to_owned(),
            imports: imports(&items),
            defined: items.iter().flat_map(defined_by).collect(),
            items: Vec::new(),
            children: BTreeMap::new(),
            parent,
        });
        for item in items {
            let path = path_attribute(&item);
            let Item::Mod(module) = item else {
                self.0[here].items.push(item);
                continue;
            };
            let name = module.ident.to_string();
            let inside = format!("{folder}{name}/");
            let child = match (module.content, path) {
                (Some((_, items)), _) => self.add(read, file, inside, here, items),
                (None, Some(path)) => {
                    let file = normalised(&format!("{}{path}", folder_of(file)));
                    self.add_file(read, &file, folder_of(&file), here)
                }
                (None, None) => {
                    let flat = format!("{folder}{name}.rs");
                    let file = if read.sources.0.contains_key(&flat) { flat } else { format!("{inside}mod.rs") };
                    self.add_file(read, &file, inside, here)
                }
            };
            self.0[here].children.insert(name, child);
        }
        here
    }
}

struct Reader<'a> {
    sources: &'a Sources,
    parse: fn(&str, &str) -> File,
}

/// The folder of a file: `a/b/` for `a/b/c.rs`.
fn folder_of(file: &str) -> String {
    file.rfind('/').map_or(String::new(), |slash| file[..=slash].to_owned())
}

/// Resolves `..` and `.`: `a/c` for `a/b/../c`.
fn normalised(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/') {
        match part {
            ".." => _ = parts.pop(),
            "." => {}
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

/// The value of `#[path = "…"]`, if a module has this attribute.
fn path_attribute(item: &Item) -> Option<String> {
    attributes(item).iter().find_map(|attribute| match &attribute.meta {
        Meta::NameValue(meta) if meta.path.is_ident("path") => match &meta.value {
            syn::Expr::Lit(syn::ExprLit { lit: Lit::Str(text), .. }) => Some(text.value()),
            _ => None,
        },
        _ => None,
    })
}

/// Names of the types, functions, constants, traits and macros that an item defines.
pub fn defined_by(item: &Item) -> Vec<String> {
    match item {
        Item::Const(item) => vec![item.ident.to_string()],
        Item::Enum(item) => vec![item.ident.to_string()],
        Item::Fn(item) => vec![item.sig.ident.to_string()],
        Item::Static(item) => vec![item.ident.to_string()],
        Item::Struct(item) => vec![item.ident.to_string()],
        Item::Trait(item) => vec![item.ident.to_string()],
        Item::Type(item) => vec![item.ident.to_string()],
        Item::Union(item) => vec![item.ident.to_string()],
        Item::Macro(item) => match &item.ident {
            Some(name) => vec![name.to_string()],
            // The arguments of a macro call show what it defines.
            None => defined_in(&tokens(item.mac.tokens.clone())).map(|token| token.text.clone()).collect(),
        },
        _ => Vec::new(),
    }
}

/// The names that follow `struct`, `enum`, `trait`, `type` or `const` in `tokens`.
pub fn defined_in(tokens: &[Token]) -> impl Iterator<Item = &Token> {
    let defines = |token: &Token| ["struct", "enum", "trait", "type", "const"].contains(&token.text.as_str());
    tokens.windows(2).filter(move |pair| defines(&pair[0])).map(|pair| &pair[1])
}
