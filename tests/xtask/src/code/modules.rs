//! The modules of a crate: what each defines, imports and mentions.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::TokenTree;
use quote::ToTokens;
use syn::{Item, Visibility};

use super::paths::{Use, mentioned, of_use};
use super::{flat, is_for_tests};

/// The path of a module from the root of its crate, which has none.
pub type ModulePath = Vec<String>;

/// A module, without its tests.
pub struct Module {
    /// Its file, below the folder of the crate's sources.
    pub file: PathBuf,
    /// The modules in it.
    pub children: BTreeSet<String>,
    /// What it defines itself.
    pub names: HashSet<String>,
    /// What it imports.
    pub uses: Vec<Use>,
    /// Paths in its items, but for imports.
    pub mentions: Vec<Vec<String>>,
    /// Words in its items, but for imports.
    pub words: HashSet<String>,
    /// Its items, but for imports and modules.
    pub items: Vec<Item>,
}

/// The modules of a crate.
pub struct Crate {
    /// By their paths.
    pub modules: BTreeMap<ModulePath, Module>,
    /// Lines of all files, tests too.
    pub lines: usize,
}

impl Crate {
    /// Reads the crate whose sources lie in a folder.
    ///
    /// # Errors
    /// A file that can't be read, or is not Rust.
    pub fn read(folder: &Path) -> Result<Crate, String> {
        let mut found = Crate { modules: BTreeMap::new(), lines: lines_below(folder)? };
        found.read_file(folder, Path::new("lib.rs"), Vec::new())?;
        Ok(found)
    }

    fn read_file(&mut self, folder: &Path, file: &Path, path: ModulePath) -> Result<(), String> {
        let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", file.display());
        let text = fs::read_to_string(folder.join(file)).map_err(|error| wrong(&error))?;
        let syntax = syn::parse_file(&text).map_err(|error| wrong(&error))?;
        self.take(folder, file, path, syntax.items)
    }

    fn take(
        &mut self,
        folder: &Path,
        file: &Path,
        path: ModulePath,
        items: Vec<Item>,
    ) -> Result<(), String> {
        let mut module = Module::empty(file);
        for item in items.into_iter().filter(|item| !is_for_tests(item)) {
            match item {
                Item::Mod(item) => {
                    let name = item.ident.to_string();
                    module.children.insert(name.clone());
                    let mut below = path.clone();
                    below.push(name);
                    match item.content {
                        Some((_, items)) => self.take(folder, file, below, items)?,
                        None => self.read_file(folder, &file_of(folder, &below), below)?,
                    }
                }
                Item::Use(item) => {
                    let is_public = !matches!(item.vis, Visibility::Inherited);
                    module.uses.extend(of_use(&item.tree, is_public));
                }
                item => module.define(item),
            }
        }
        self.modules.insert(path, module);
        Ok(())
    }
}

/// The file of a module.
fn file_of(folder: &Path, path: &ModulePath) -> PathBuf {
    let plain = path.iter().collect::<PathBuf>();
    let file = plain.with_extension("rs");
    if folder.join(&file).is_file() { file } else { plain.join("mod.rs") }
}

/// Lines of all sources below a folder.
fn lines_below(folder: &Path) -> Result<usize, String> {
    let wrong = |error| format!("{}: {error}", folder.display());
    let mut lines = 0;
    for entry in fs::read_dir(folder).map_err(wrong)? {
        let path = entry.map_err(wrong)?.path();
        if path.is_dir() {
            lines += lines_below(&path)?;
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            lines += fs::read_to_string(&path).map_err(wrong)?.lines().count();
        }
    }
    Ok(lines)
}

impl Module {
    fn empty(file: &Path) -> Module {
        Module {
            file: file.to_path_buf(),
            children: BTreeSet::new(),
            names: HashSet::new(),
            uses: Vec::new(),
            mentions: Vec::new(),
            words: HashSet::new(),
            items: Vec::new(),
        }
    }

    fn define(&mut self, item: Item) {
        let name = match &item {
            Item::Const(item) => Some(&item.ident),
            Item::Enum(item) => Some(&item.ident),
            Item::Fn(item) => Some(&item.sig.ident),
            Item::Macro(item) => item.ident.as_ref(),
            Item::Static(item) => Some(&item.ident),
            Item::Struct(item) => Some(&item.ident),
            Item::Trait(item) => Some(&item.ident),
            Item::Type(item) => Some(&item.ident),
            Item::Union(item) => Some(&item.ident),
            _ => None,
        };
        self.names.extend(name.map(ToString::to_string));
        let tokens = item.to_token_stream();
        self.mentions.extend(mentioned(tokens.clone()));
        let mut trees = Vec::new();
        flat(tokens, &mut trees);
        self.words.extend(trees.iter().filter_map(|tree| match tree {
            TokenTree::Ident(name) => Some(name.to_string()),
            _ => None,
        }));
        // A macro may define what it is given: `codes! { pub enum … }`.
        if matches!(&item, Item::Macro(_)) {
            let defined = trees.windows(2).filter_map(|pair| match pair {
                [TokenTree::Ident(kind), TokenTree::Ident(name)] => {
                    let kinds = ["enum", "struct", "fn", "const", "type", "trait"];
                    kinds.iter().any(|word| kind == word).then(|| name.to_string())
                }
                _ => None,
            });
            self.names.extend(defined);
        }
        self.items.push(item);
    }
}
