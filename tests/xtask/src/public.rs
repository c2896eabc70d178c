//! The public API of the crate that people embed, item by item, must be that of
//! `tests/api/filpost.txt`: `FILPOST_UPDATE=1 cargo test -p filpost-xtask public` writes the file
//! anew, and its difference is the difference of the API.
//!
//! What `#[doc(hidden)]` hides is none of it. Types of inner crates are listed with all that can be
//! reached through them, as semver asks.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use quote::ToTokens;
use syn::{Attribute, Fields, ImplItem, Item, Meta, TraitItem, Visibility};

use crate::code::modules::{Crate, Module, ModulePath};
use crate::code::paths::of_use;

/// The crate whose API is listed.
const FACADE: &str = "filpost";

/// The crates that it may take items from.
const INNER: &[&str] = &[
    "fil-cl",
    "fil-diag",
    "fil-machine",
    "fil-nc",
    "fil-post",
    "fil-stock",
    "fil-syntax",
    "fil-text",
    "fil-vm",
    FACADE,
];

/// Items of the API, a line each, with their doc comments; that of a field begins with that of its
/// type.
type Lines = BTreeMap<String, String>;

/// Where an item is defined: crate and module.
type Home<'s> = (&'s str, &'s ModulePath);

struct Sources {
    crates: BTreeMap<String, Crate>,
}

impl Sources {
    fn read(root: &Path) -> Result<Sources, String> {
        let read = |name: &&str| {
            let source = Crate::read(&root.join("crates").join(name).join("src"))?;
            Ok((name.replace('-', "_"), source))
        };
        let crates = INNER.iter().map(read).collect::<Result<_, String>>()?;
        Ok(Sources { crates })
    }

    /// Where the item of a path is defined, seen from a module; `None` in a crate of others.
    fn resolve(&self, from: Home<'_>, path: &[String]) -> Option<(Home<'_>, String)> {
        let (name, parents) = path.split_last()?;
        let (mut krate, mut module) = (from.0, from.1.clone());
        for (index, part) in parents.iter().enumerate() {
            match part.as_str() {
                "crate" => module.clear(),
                "self" => {}
                "super" => drop(module.pop()),
                part if self.module(krate, &module)?.children.contains(part) => {
                    module.push(part.into());
                }
                part if index == 0 && self.crates.contains_key(part) => {
                    (krate, module) = (part, ModulePath::new());
                }
                _ => return None,
            }
        }
        let (krate, source) = self.crates.get_key_value(krate)?;
        let (path, found) = source.modules.get_key_value(&module)?;
        if found.names.contains(name) {
            return Some(((krate, path), name.clone()));
        }
        let imported = found.uses.iter().find(|used| &used.name == name)?;
        self.resolve((krate, path), &imported.path)
    }

    fn module(&self, krate: &str, path: &ModulePath) -> Option<&Module> {
        self.crates.get(krate)?.modules.get(path)
    }

    /// The lines of an item that is public under a path.
    fn item(&self, shown: &str, (krate, module): Home<'_>, name: &str, out: &mut Lines) {
        let Some(home) = self.module(krate, module) else { return };
        for item in &home.items {
            define(shown, item, name, out);
        }
        for (path, other) in &self.crates[krate].modules {
            // A module with a type of the same name means its own.
            if path == module || !other.names.contains(name) {
                for item in &other.items {
                    implement(shown, item, name, out);
                }
            }
        }
    }
}

/// The lines of an item's own definition.
fn define(shown: &str, item: &Item, name: &str, out: &mut Lines) {
    match item {
        Item::Struct(item) if item.ident == name => {
            let docs = docs(&item.attrs);
            fields(shown, &item.fields, &docs, true, out);
            out.insert(
                format!("struct {shown}{}{}", tidy(&item.generics), told(&item.attrs)),
                docs,
            );
        }
        Item::Enum(item) if item.ident == name => {
            let whole = docs(&item.attrs);
            out.insert(
                format!("enum {shown}{}{}", tidy(&item.generics), told(&item.attrs)),
                whole.clone(),
            );
            for variant in item.variants.iter().filter(|variant| !is_hidden(&variant.attrs)) {
                let path = format!("{shown}::{}", variant.ident);
                let types: Vec<String> = match &variant.fields {
                    Fields::Unnamed(of) => of.unnamed.iter().map(|field| tidy(&field.ty)).collect(),
                    _ => Vec::new(),
                };
                let types = if types.is_empty() {
                    String::new()
                } else {
                    format!("({})", types.join(", "))
                };
                let docs = format!("{whole} {}", docs(&variant.attrs));
                if let Fields::Named(_) = variant.fields {
                    fields(&path, &variant.fields, &docs, false, out);
                }
                out.insert(format!("variant {path}{types}{}", told(&variant.attrs)), docs);
            }
        }
        Item::Trait(item) if item.ident == name => {
            out.insert(format!("trait {shown}{}", tidy(&item.generics)), docs(&item.attrs));
            for item in &item.items {
                if let TraitItem::Fn(item) = item {
                    out.insert(format!("fn {shown}::{}", signature(&item.sig)), docs(&item.attrs));
                }
            }
        }
        Item::Fn(item) if item.sig.ident == name && is_public(&item.vis) => {
            let signature = signature(&item.sig);
            let rest = signature.strip_prefix(name).unwrap_or(&signature);
            out.insert(format!("fn {shown}{rest}"), docs(&item.attrs));
        }
        Item::Const(item) if item.ident == name && is_public(&item.vis) => {
            out.insert(format!("const {shown}: {}", tidy(&item.ty)), docs(&item.attrs));
        }
        Item::Type(item) if item.ident == name && is_public(&item.vis) => {
            out.insert(format!("type {shown} = {}", tidy(&item.ty)), docs(&item.attrs));
        }
        _ => {}
    }
}

/// The lines of what a block implements for a type.
fn implement(shown: &str, item: &Item, name: &str, out: &mut Lines) {
    let Item::Impl(block) = item else { return };
    let syn::Type::Path(of) = &*block.self_ty else { return };
    if of.path.segments.last().is_none_or(|part| part.ident != name) {
        return;
    }
    if let Some((path, _)) = &block.trait_ {
        out.insert(format!("impl {} for {shown}", tidy(path)), String::new());
        return;
    }
    for item in &block.items {
        match item {
            ImplItem::Fn(item) if is_public(&item.vis) && !is_hidden(&item.attrs) => {
                out.insert(format!("fn {shown}::{}", signature(&item.sig)), docs(&item.attrs));
            }
            ImplItem::Const(item) if is_public(&item.vis) && !is_hidden(&item.attrs) => {
                let line = format!("const {shown}::{}: {}", item.ident, tidy(&item.ty));
                out.insert(line, docs(&item.attrs));
            }
            _ => {}
        }
    }
}

fn fields(path: &str, of: &Fields, whole: &str, need_pub: bool, out: &mut Lines) {
    for (index, field) in of.iter().enumerate() {
        if (need_pub && !is_public(&field.vis)) || is_hidden(&field.attrs) {
            continue;
        }
        let name = field.ident.as_ref().map_or_else(|| index.to_string(), ToString::to_string);
        let docs = format!("{whole} {}", docs(&field.attrs));
        out.insert(format!("field {path}::{name}: {}", tidy(&field.ty)), docs);
    }
}

/// Derived traits and what else a user depends on.
fn told(attributes: &[Attribute]) -> String {
    let mut told = String::new();
    for attribute in attributes {
        let path = attribute.path();
        if path.is_ident("derive") || path.is_ident("non_exhaustive") || path.is_ident("must_use") {
            let text = tidy(&attribute.meta);
            told += &format!(" #[{}]", text.split(" = ").next().unwrap_or_default());
        }
    }
    told
}

/// The doc comment.
fn docs(attributes: &[Attribute]) -> String {
    let mut text = String::new();
    for attribute in attributes.iter().filter(|attribute| attribute.path().is_ident("doc")) {
        if let Meta::NameValue(syn::MetaNameValue { value: syn::Expr::Lit(line), .. }) =
            &attribute.meta
            && let syn::Lit::Str(line) = &line.lit
        {
            text += &line.value();
        }
    }
    text
}

fn is_public(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}

fn is_hidden(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("doc")
            && attribute.meta.to_token_stream().to_string().contains("hidden")
    })
}

/// The signature without `fn`.
fn signature(of: &syn::Signature) -> String {
    let text = tidy(of);
    match text.split_once("fn ") {
        Some(("", rest)) => rest.to_string(),
        Some((before, rest)) => format!("{rest} [{}]", before.trim()),
        None => text,
    }
}

/// Tokens as rustfmt would put them on one line, nearly.
fn tidy(of: &impl ToTokens) -> String {
    let text = of.to_token_stream().to_string();
    let mut text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    for (from, to) in [
        (" :: ", "::"),
        (":: ", "::"),
        (" < ", "<"),
        ("< ", "<"),
        (" >", ">"),
        (" ,", ","),
        (" :", ":"),
        ("& ", "&"),
        (" (", "("),
        ("( ", "("),
        (" )", ")"),
        (" [", "["),
        ("->(", "-> ("),
        ("->[", "-> ["),
        ("=(", "= ("),
        (" ;", ";"),
        (",[", ", ["),
        (":[", ": ["),
        ("static[", "static ["),
        ("'a[", "'a ["),
        (",)", ")"),
        (", >", ">"),
        ("- >", "->"),
    ] {
        text = text.replace(from, to);
    }
    text.trim().to_string()
}

/// The whole API.
fn items(root: &Path) -> Result<Lines, String> {
    let sources = Sources::read(root)?;
    let mut out = Lines::new();
    let folder = root.join("crates").join(FACADE).join("src");
    module(&sources, &folder, ModulePath::new(), &mut out)?;
    Ok(out)
}

/// One line an item, in the order of the alphabet.
fn listing(root: &Path) -> Result<String, String> {
    Ok(items(root)?.into_keys().map(|line| line + "\n").collect())
}

/// The lines of a visible module and of those in it.
fn module(
    sources: &Sources,
    folder: &Path,
    path: ModulePath,
    out: &mut Lines,
) -> Result<(), String> {
    let home = sources.module(FACADE, &path).ok_or_else(|| format!("no module {path:?}"))?;
    let text = fs::read_to_string(folder.join(&home.file)).map_err(|error| error.to_string())?;
    let syntax = syn::parse_file(&text).map_err(|error| error.to_string())?;
    let shown = [&[FACADE.to_string()], &path[..]].concat().join("::");
    out.insert(format!("mod {shown}"), docs(&syntax.attrs));
    for item in &syntax.items {
        match item {
            Item::Mod(item) if is_public(&item.vis) && !is_hidden(&item.attrs) => {
                let below = [&path[..], &[item.ident.to_string()]].concat();
                module(sources, folder, below, out)?;
            }
            Item::Use(item) if is_public(&item.vis) && !is_hidden(&item.attrs) => {
                for used in of_use(&item.tree, true) {
                    let shown = format!("{shown}::{}", used.name);
                    match sources.resolve((FACADE, &path), &used.path) {
                        Some((home, name)) => sources.item(&shown, home, &name, out),
                        None => {
                            let line = format!("use {shown} = {}", used.path.join("::"));
                            out.insert(line, docs(&item.attrs));
                        }
                    }
                }
            }
            item => own(sources, &shown, &path, item, out),
        }
    }
    Ok(())
}

/// The lines of an item that a visible module defines itself.
fn own(sources: &Sources, shown: &str, path: &ModulePath, item: &Item, out: &mut Lines) {
    let (visibility, attributes, name) = match item {
        Item::Const(item) => (&item.vis, &item.attrs, &item.ident),
        Item::Enum(item) => (&item.vis, &item.attrs, &item.ident),
        Item::Fn(item) => (&item.vis, &item.attrs, &item.sig.ident),
        Item::Struct(item) => (&item.vis, &item.attrs, &item.ident),
        Item::Trait(item) => (&item.vis, &item.attrs, &item.ident),
        Item::Type(item) => (&item.vis, &item.attrs, &item.ident),
        _ => return,
    };
    if is_public(visibility) && !is_hidden(attributes) {
        sources.item(&format!("{shown}::{name}"), (FACADE, path), &name.to_string(), out);
    }
}

#[test]
fn the_public_api_is_that_of_its_file() {
    let root = filpost_tests::root();
    let found = listing(root).unwrap();
    let file = root.join("tests/api/filpost.txt");
    if std::env::var_os("FILPOST_UPDATE").is_some() {
        fs::create_dir_all(file.parent().expect("a folder")).unwrap();
        fs::write(&file, &found).unwrap();
    }
    let held = fs::read_to_string(&file).unwrap_or_default();
    let (held, found): (BTreeSet<&str>, BTreeSet<&str>) =
        (held.lines().collect(), found.lines().collect());
    let gone: Vec<String> = held.difference(&found).map(|line| format!("- {line}")).collect();
    let new: Vec<String> = found.difference(&held).map(|line| format!("+ {line}")).collect();
    assert!(
        gone.is_empty() && new.is_empty(),
        "the public API is another than tests/api/filpost.txt says:\n{}\nHide what is no API with \
         #[doc(hidden)]. For the rest: FILPOST_UPDATE=1 cargo test -p filpost-xtask public, and a \
         line in CHANGELOG.md for what is gone.",
        [gone, new].concat().join("\n")
    );
}

/// What a number with a fraction counts, in the words of doc comments.
const UNITS: &[&str] =
    &["degree", "factor", "inch", "millimeter", "mm", "per ", "ratio", "seconds", "unit", "Year"];

/// Who reads a length needs its unit, and whether it is that of the CL file.
#[test]
fn each_number_has_a_unit() {
    let items = items(filpost_tests::root()).unwrap();
    let is_number = |line: &str| {
        let gives = match line.split_once(' ') {
            Some(("field" | "const", rest)) => rest.split_once(": ").map(|(_, of)| of),
            Some(("fn", rest)) => rest.split_once("-> ").map(|(_, of)| of),
            _ => None,
        };
        gives.is_some_and(|of| of.contains("f64") || of.contains("f32"))
    };
    let numbers: Vec<_> = items.iter().filter(|(line, _)| is_number(line)).collect();
    assert!(numbers.len() > 20, "{numbers:?}");
    let without: Vec<&str> = numbers
        .into_iter()
        .filter(|(_, docs)| !UNITS.iter().any(|unit| docs.contains(unit)))
        .map(|(line, _)| line.as_str())
        .collect();
    assert!(without.is_empty(), "doc comments without a unit:\n{}", without.join("\n"));
}

#[test]
fn what_is_hidden_is_not_listed() {
    let found = listing(filpost_tests::root()).unwrap();
    for (name, is_listed) in [
        ("fn filpost::Program::post(", true),
        ("field filpost::Limits::fuel: u64", true),
        ("filpost::Program::commons", false),
        ("filpost::cl", false),
        ("mod filpost::debug", false),
    ] {
        assert_eq!(found.lines().any(|line| line.contains(name)), is_listed, "{name}");
    }
}

/// Keys and numbers that were once released go on to mean the same. The file has all of them; what
/// is new is added by `FILPOST_UPDATE`, and nothing is taken out.
fn never_gone(file: &str, found: BTreeSet<String>, old: impl Fn(&str) -> bool) {
    let file = filpost_tests::root().join("tests/api").join(file);
    let text = fs::read_to_string(&file).unwrap_or_default();
    let mut held: BTreeSet<String> = text.lines().map(str::to_string).collect();
    if std::env::var_os("FILPOST_UPDATE").is_some() {
        held.extend(found.iter().cloned());
        fs::write(&file, held.iter().map(|line| format!("{line}\n")).collect::<String>()).unwrap();
    }
    let gone: Vec<&String> =
        held.iter().filter(|name| !found.contains(*name) && !old(name)).collect();
    assert!(
        gone.is_empty(),
        "{gone:?} in {} is gone; see docs/architecture.md, Names that stay",
        file.display()
    );
    let new: Vec<&String> = found.difference(&held).collect();
    assert!(
        new.is_empty(),
        "{new:?}: FILPOST_UPDATE=1 cargo test -p filpost-xtask public adds them"
    );
}

#[test]
fn keys_of_settings_stay() {
    let row = |row: &filpost::locations::Location| row.name.to_string();
    let keys = filpost::locations::TABLE.iter().map(row).collect();
    never_gone("keys.txt", keys, |old| filpost::locations::Location::named(old).is_some());
}

#[test]
fn numbers_of_codes_stay() {
    // Each code has a page; a test sees to that.
    let pages = fs::read_dir(filpost_tests::root().join("docs/errors")).unwrap();
    let pages = pages.map(|page| page.unwrap().file_name().into_string().unwrap());
    let numbers = pages.filter_map(|page| Some(page.strip_suffix(".md")?.get(1..)?.to_string()));
    let is_number = |name: &String| name.bytes().all(|byte| byte.is_ascii_digit());
    never_gone("codes.txt", numbers.filter(is_number).collect(), |_| false);
}

#[test]
fn the_host_program_needs_nothing_else() {
    let root = filpost_tests::root();
    let listed = listing(root).unwrap();
    let text = fs::read_to_string(root.join("crates/filpost/tests/host.rs")).unwrap();
    let syntax = syn::parse_file(&text).unwrap();
    let mut names = 0;
    for item in &syntax.items {
        let Item::Use(item) = item else { continue };
        for used in of_use(&item.tree, false).iter().filter(|used| used.path[0] == FACADE) {
            let line = format!(" {}", used.path.join("::"));
            assert!(listed.contains(&line), "{line} is no API");
            names += 1;
        }
    }
    assert!(names > 4);
    assert_eq!(text.matches("filpost::").count(), 1, "all names are imported at the top");
}
