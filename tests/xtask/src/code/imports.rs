//! Which file of a crate uses which: by imports and by paths in the text, each followed to the
//! file that defines what is named. What a file only passes on is no use of it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::modules::{Crate, Module, ModulePath};

/// Files, and which uses which.
pub struct Imports {
    /// For each file those that it uses.
    pub arrows: BTreeMap<String, BTreeSet<String>>,
}

/// Renames that lead to a name are followed so far.
const DEPTH: usize = 16;

impl Imports {
    /// The imports of a crate.
    pub fn of(source: &Crate) -> Imports {
        let mut arrows: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for (path, module) in &source.modules {
            let file = name_of(&module.file);
            let used = arrows.entry(file.clone()).or_default();
            used.extend(uses(source, path, module).into_iter().filter(|other| *other != file));
        }
        Imports { arrows }
    }

    /// What the `use` lines for `crate`, `self` and `super` name, each with the file it leads
    /// to by its names alone: where a module passes names of others on, with its own file.
    pub fn by_use(source: &Crate) -> Imports {
        let mut arrows: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for (path, module) in &source.modules {
            let file = name_of(&module.file);
            let used = arrows.entry(file.clone()).or_default();
            let uses =
                module.uses.iter().filter(|import| !module.children.contains(&import.path[0]));
            let named = uses.filter_map(|import| {
                let whole = absolute(path, module, &import.path)?;
                let mut parts = (0..=whole.len()).rev().map(|count| &whole[..count]);
                parts.find_map(|part| source.modules.get(part))
            });
            used.extend(named.map(|module| name_of(&module.file)).filter(|other| *other != file));
        }
        Imports { arrows }
    }

    /// The largest set of files that all use each other, by way of others or straight.
    pub fn circle(&self) -> BTreeSet<&str> {
        let reach: BTreeMap<&str, BTreeSet<&str>> =
            self.arrows.keys().map(|file| (file.as_str(), self.reach(file))).collect();
        let circle = |file: &str| -> BTreeSet<&str> {
            let back = reach[file].iter().filter(|other| reach[*other].contains(file));
            back.copied().collect()
        };
        reach.keys().map(|file| circle(file)).max_by_key(BTreeSet::len).unwrap_or_default()
    }

    fn reach(&self, file: &str) -> BTreeSet<&str> {
        let (mut found, mut open) = (BTreeSet::new(), vec![file]);
        while let Some(file) = open.pop() {
            for next in self.arrows.get(file).into_iter().flatten() {
                if found.insert(next.as_str()) {
                    open.push(next);
                }
            }
        }
        found
    }

    /// Which folder or file right below the root uses which, with the files that make it so.
    pub fn between_tops(&self) -> BTreeMap<(&str, &str), Vec<(&str, &str)>> {
        let mut tops: BTreeMap<(&str, &str), Vec<(&str, &str)>> = BTreeMap::new();
        for (file, used) in &self.arrows {
            // The root names all modules and passes on what is public.
            let others = used.iter().filter(|other| top(file) != top(other));
            for other in others.filter(|_| file != ROOT) {
                tops.entry((top(file), top(other))).or_default().push((file, other));
            }
        }
        tops
    }
}

const ROOT: &str = "lib.rs";

/// The folder or file right below the root that a file belongs to.
fn top(file: &str) -> &str {
    let first = file.split('/').next().unwrap_or(file);
    first.strip_suffix(".rs").unwrap_or(first)
}

fn name_of(file: &Path) -> String {
    file.to_string_lossy().replace('\\', "/")
}

/// The files that a module uses.
fn uses(source: &Crate, path: &ModulePath, module: &Module) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for import in &module.uses {
        // Passed on, and not needed here.
        if import.is_public && !module.words.contains(&import.name) {
            continue;
        }
        found.extend(target(source, path, module, &import.path));
    }
    for mention in &module.mentions {
        let mut mention = mention.clone();
        let import = module.uses.iter().find(|import| import.name == mention[0]);
        if let Some(import) = import.filter(|_| !module.children.contains(&mention[0])) {
            mention.splice(0..1, import.path.iter().cloned());
        }
        found.extend(target(source, path, module, &mention));
    }
    found
}

/// The file that defines what a path of a module names; `None` outside of the crate.
fn target(source: &Crate, at: &ModulePath, module: &Module, path: &[String]) -> Option<String> {
    let whole = absolute(at, module, path)?;
    let found = resolve(source, &whole, DEPTH)?;
    Some(name_of(&source.modules.get(&found)?.file))
}

/// A path from the root of the crate; `None` for one that leads out of it.
fn absolute(at: &ModulePath, module: &Module, path: &[String]) -> Option<ModulePath> {
    let (mut whole, mut rest) = (at.clone(), path);
    match rest.first()?.as_str() {
        "crate" => {
            whole.clear();
            rest = &rest[1..];
        }
        "self" => rest = &rest[1..],
        "super" => {}
        name if module.children.contains(name) => {}
        _ => return None,
    }
    while rest.first().is_some_and(|name| name == "super") {
        whole.pop();
        rest = &rest[1..];
    }
    whole.extend(rest.iter().filter(|name| *name != "self").cloned());
    Some(whole)
}

/// The module that defines what a path from the root names.
fn resolve(source: &Crate, path: &[String], depth: usize) -> Option<ModulePath> {
    let mut at = ModulePath::new();
    for (index, name) in path.iter().enumerate() {
        let module = source.modules.get(&at)?;
        let is_last = index + 1 == path.len();
        if module.children.contains(name) && !(is_last && module.names.contains(name)) {
            at.push(name.clone());
            continue;
        }
        if module.names.contains(name) {
            return Some(at);
        }
        return passed_on(source, &at, module, &path[index..], depth).or(Some(at));
    }
    Some(at)
}

/// The module behind a name that another imports.
fn passed_on(
    source: &Crate,
    at: &ModulePath,
    module: &Module,
    path: &[String],
    depth: usize,
) -> Option<ModulePath> {
    let depth = depth.checked_sub(1)?;
    if let Some(import) = module.uses.iter().find(|import| import.name == path[0]) {
        let mut whole = absolute(at, module, &import.path)?;
        whole.extend_from_slice(&path[1..]);
        return resolve(source, &whole, depth);
    }
    let globs = module.uses.iter().filter(|import| import.name == "*");
    let modules = globs.filter_map(|import| absolute(at, module, &import.path));
    modules.into_iter().find_map(|whole| {
        let holder = resolve(source, &whole, depth)?;
        let names = &source.modules.get(&holder)?.names;
        names.contains(&path[0]).then_some(holder)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A crate of these files.
    fn crate_of(files: &[(&str, &str)]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let path = folder.path().join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        }
        folder
    }

    fn read(files: &[(&str, &str)]) -> Imports {
        Imports::of(&Crate::read(crate_of(files).path()).unwrap())
    }

    fn used<'i>(imports: &'i Imports, file: &str) -> Vec<&'i str> {
        imports.arrows[file].iter().map(String::as_str).collect()
    }

    #[test]
    fn names_are_followed_to_where_they_are_defined() {
        let imports = read(&[
            ("lib.rs", "mod a; mod b; pub mod c; pub use b::B;"),
            ("a.rs", "use crate::b::{B, E}; use super::c; fn f(b: B, e: E) { c::d::g(); }"),
            ("b.rs", "pub struct B; pub use crate::c::E;"),
            ("c/mod.rs", "pub mod d; mod e; pub use e::*;"),
            ("c/d.rs", "pub fn g() { let _ = super::E; crate::B; }"),
            ("c/e.rs", "codes! { pub enum E { One } }\n#[cfg(test)] mod tests { use crate::a; }"),
        ]);
        assert_eq!(used(&imports, "a.rs"), ["b.rs", "c/d.rs", "c/e.rs", "c/mod.rs"]);
        assert!(used(&imports, "b.rs").is_empty(), "what is passed on is not used");
        assert_eq!(used(&imports, "c/d.rs"), ["b.rs", "c/e.rs"]);
        assert!(used(&imports, "c/e.rs").is_empty());
        assert!(used(&imports, "c/mod.rs").is_empty());
        assert!(imports.circle().is_empty());
    }

    #[test]
    fn use_lines_lead_to_the_module_that_they_name() {
        let folder = crate_of(&[
            ("lib.rs", "mod a; mod b; pub mod c;"),
            ("a.rs", "use crate::b::E; fn f(e: E) { crate::c::g() }"),
            ("b.rs", "pub use crate::c::E;"),
            ("c.rs", "mod d; use d::h; pub struct E; pub fn g() { h() }"),
            ("c/d.rs", "use super::E; pub fn h() {}"),
        ]);
        let imports = Imports::by_use(&Crate::read(folder.path()).unwrap());
        assert_eq!(used(&imports, "a.rs"), ["b.rs"]);
        assert_eq!(used(&imports, "b.rs"), ["c.rs"]);
        assert!(used(&imports, "c.rs").is_empty());
        assert_eq!(used(&imports, "c/d.rs"), ["c.rs"]);
    }

    #[test]
    fn a_circle_is_all_files_on_a_way_back() {
        let imports = read(&[
            ("lib.rs", "mod a; mod b; mod c; mod d;"),
            ("a.rs", "pub fn a() { crate::b::b() }"),
            ("b.rs", "pub fn b() { crate::c::c() }"),
            ("c.rs", "pub fn c() { crate::a::a(); crate::d::d() }"),
            ("d.rs", "pub fn d() {}"),
        ]);
        let circle: Vec<&str> = imports.circle().into_iter().collect();
        assert_eq!(circle, ["a.rs", "b.rs", "c.rs"]);
    }

    #[test]
    fn arrows_between_tops_name_the_files() {
        let imports = read(&[
            ("lib.rs", "mod a; mod b;"),
            ("a/mod.rs", "mod x; fn f() { x::g() }"),
            ("a/x.rs", "use crate::b::T; pub fn g() { T; super::f() }"),
            ("b.rs", "pub struct T;"),
        ]);
        let tops: Vec<_> = imports.between_tops().into_iter().collect();
        assert_eq!(tops, [(("a", "b"), vec![("a/x.rs", "b.rs")])]);
        assert_eq!(imports.circle().len(), 2, "a module and one in it");
    }
}
