//! The files of a run: where they are now, and that they have not changed.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{BufRead, BufReader, Seek, SeekFrom};
use std::path::{Component, Path, PathBuf};

use fil_diag::Diag;
use fil_text::CodePage;

use super::digests::Digests;
use super::{FilePosition, Options, line_search};
use crate::error::{Error, RunCode};
use crate::files;
use crate::map::{Digest, MapFile, MapReader};

/// What a file was in the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// The NC program.
    Nc,
    /// The CL file.
    Cl,
    /// A FIL file, by its number.
    Fil(u16),
}

/// The files of a run.
pub(super) struct RunFiles {
    /// What the file asked about was.
    pub role: Role,
    /// Files that are not where the map says.
    pub missing: Vec<String>,
    cl: At,
    nc: At,
    fil: Vec<(String, Option<Vec<String>>)>,
    /// Encoding of the NC program.
    page: CodePage,
}

/// A file by the name that is shown and, when it is there, its path.
struct At {
    shown: String,
    path: Option<PathBuf>,
}

impl RunFiles {
    /// Finds the files: the one asked about where the user says, the others
    /// where the map says.
    ///
    /// # Errors
    /// E0708 for a file that has changed since, or that the run did not know.
    pub fn find(
        map: &MapReader<File>,
        at: &Path,
        place: &FilePosition,
        options: &Options,
    ) -> Result<RunFiles, Error> {
        let folder = at.parent().unwrap_or(Path::new(""));
        let given = &options.cl_file;
        let long = [map.cl(), map.nc()].map(|file| tidy(&folder.join(&file.name)));
        let named = given.iter().chain([&place.file]).cloned().chain(long);
        let mut digests = Digests::of_all(named);
        let role = role(map, folder, &place.file, options, &mut digests)?;
        let mut path = |of: Role, file: &MapFile, given: Option<&PathBuf>| match given {
            _ if of == role => place.file.clone(),
            Some(given) => given.clone(),
            None => place_of(file, folder, &mut digests),
        };
        let mut given_fil = given_fil(map, options)?;
        let cl_path = path(Role::Cl, map.cl(), given.as_ref());
        let nc_path = path(Role::Nc, map.nc(), None);
        let fil_paths: Vec<PathBuf> = (0..)
            .zip(map.fil())
            .map(|(number, file)| path(Role::Fil(number), file, given_fil.remove(&number).as_ref()))
            .collect();
        let mut missing = Vec::new();
        let cl = at_hand(map.cl(), cl_path, &mut missing, &mut digests)?;
        let nc = at_hand(map.nc(), nc_path, &mut missing, &mut digests)?;
        let mut fil = Vec::new();
        for (file, path) in map.fil().iter().zip(fil_paths) {
            let lines = fil_lines(file, &path, options, &mut missing)?;
            fil.push((path.display().to_string(), lines));
        }
        Ok(RunFiles { role, missing, cl, nc, fil, page: map.nc_page() })
    }

    /// The CL file, when it is at hand.
    pub fn cl(&self) -> Option<&Path> {
        self.cl.path.as_deref()
    }

    /// What the CL file is called.
    pub fn cl_name(&self) -> String {
        self.cl.shown.clone()
    }

    /// What a FIL file is called.
    pub fn fil_name(&self, file: u16) -> String {
        self.fil.get(usize::from(file)).map(|(name, _)| name.clone()).unwrap_or_default()
    }

    /// A line of a FIL file, when it is at hand.
    pub fn fil_line(&self, file: u16, line: u64) -> Option<String> {
        let (_, lines) = self.fil.get(usize::from(file))?;
        lines.as_ref()?.get(usize::try_from(line).ok()?.checked_sub(1)?).cloned()
    }

    /// Number of lines of a FIL file.
    pub fn fil_line_count(&self, file: u16) -> u64 {
        let lines = self.fil.get(usize::from(file)).and_then(|(_, lines)| lines.as_ref());
        lines.map_or(0, |lines| lines.len() as u64)
    }

    /// Lines of the NC program by number; none when it is not at hand.
    pub fn nc_lines(&self, wanted: &BTreeSet<u64>) -> Result<BTreeMap<u64, String>, Error> {
        let mut found = BTreeMap::new();
        let Some(path) = &self.nc.path else { return Ok(found) };
        let (Some(first), Some(last)) = (wanted.first(), wanted.last()) else { return Ok(found) };
        let cant = |error| files::cant_read(path, &error);
        let mut file = File::open(path).map_err(cant)?;
        let Some(offset) = line_search::offset(&mut file, *first).map_err(cant)? else {
            return Ok(found);
        };
        file.seek(SeekFrom::Start(offset)).map_err(cant)?;
        let mut input = BufReader::with_capacity(1 << 18, file);
        let mut line = Vec::new();
        for number in *first..=*last {
            line.clear();
            if input.read_until(b'\n', &mut line).map_err(cant)? == 0 {
                break;
            }
            if wanted.contains(&number) {
                let text = self.page.decode_all(&line);
                found.insert(number, text.trim_end_matches('\n').to_string());
            }
        }
        Ok(found)
    }

    /// The byte of a column, from 1 and in characters, of a line of the NC program.
    pub fn nc_byte(&self, line: u64, column: u64) -> Result<Option<usize>, Error> {
        let lines = self.nc_lines(&BTreeSet::from([line]))?;
        let index = usize::try_from(column).ok().and_then(|column| column.checked_sub(1));
        let text = lines.get(&line);
        Ok(index.and_then(|index| Some(text?.char_indices().nth(index)?.0)))
    }
}

/// What a file was in the run: told by its content, else by its name.
fn role(
    map: &MapReader<File>,
    folder: &Path,
    file: &Path,
    options: &Options,
    digests: &mut Digests,
) -> Result<Role, Error> {
    let fil = map.fil().iter().enumerate().map(|(number, file)| (Role::Fil(number as u16), file));
    let files: Vec<(Role, &MapFile)> =
        [(Role::Nc, map.nc()), (Role::Cl, map.cl())].into_iter().chain(fil).collect();
    let digest = digests.of(file)?;
    if digest == map.nc().digest {
        return Ok(Role::Nc);
    }
    if digest == map.cl().digest {
        return Ok(Role::Cl);
    }
    let text = if map.fil().is_empty() { None } else { digest_of_text(file, options).ok() };
    let same = |(role, known): &&(Role, &MapFile)| {
        matches!(role, Role::Fil(_)) && text.as_ref() == Some(&known.digest)
    };
    let real = |path: &Path| path.canonicalize().ok();
    let named = |(_, known): &&(Role, &MapFile)| {
        real(file).is_some_and(|file| real(&folder.join(&known.name)) == Some(file))
    };
    if let Some((role, _)) = files.iter().find(same) {
        return Ok(*role);
    }
    let shown = file.display().to_string();
    match files.iter().find(named) {
        Some((Role::Fil(_), known)) => known.check(&shown, &text.unwrap_or(digest))?,
        Some((_, known)) => known.check(&shown, &digest)?,
        None => {}
    }
    let names: Vec<&str> = files.iter().map(|(_, known)| known.name.as_str()).collect();
    let message = format!("{shown} is none of the files of this map: {}", names.join(", "));
    Err(Error::setup(Diag::new(RunCode::OtherRun, message)))
}

/// Where a file is: where it lay as seen from the map, else by its plain name beside
/// the map or in the current folder, if it has not changed.
fn place_of(file: &MapFile, folder: &Path, digests: &mut Digests) -> PathBuf {
    let at = tidy(&folder.join(&file.name));
    if at.is_file() {
        return at;
    }
    let Some(name) = Path::new(&file.name).file_name() else { return at };
    let others = [folder.join(name), PathBuf::from(name)];
    let found = others.into_iter().find(|path| {
        std::fs::metadata(path).is_ok_and(|found| found.is_file())
            && digests.of(path).is_ok_and(|digest| digest == file.digest)
    });
    found.unwrap_or(at)
}

/// The FIL files that the user names, by their numbers in the map.
fn given_fil(map: &MapReader<File>, options: &Options) -> Result<BTreeMap<u16, PathBuf>, Error> {
    let mut given = BTreeMap::new();
    for path in &options.fil_files {
        let digest = digest_of_text(path, options)?;
        let mut numbered = (0..).zip(map.fil());
        let same = numbered.clone().find(|(_, file)| file.digest == digest);
        let named =
            || numbered.find(|(_, file)| Path::new(&file.name).file_name() == path.file_name());
        let Some((number, _)) = same.or_else(named) else {
            let names: Vec<&str> = map.fil().iter().map(|file| file.name.as_str()).collect();
            let shown = path.display();
            let message =
                format!("{shown} is none of the FIL files of this map: {}", names.join(", "));
            return Err(Error::setup(Diag::new(RunCode::OtherRun, message)));
        };
        given.insert(number, path.clone());
    }
    Ok(given)
}

fn digest_of_text(path: &Path, options: &Options) -> Result<Digest, Error> {
    let text = files::read_text(path, options.encoding.as_deref())?;
    Ok(Digest::of(text.as_bytes()))
}

/// A file where it should be; noted when it is not there.
fn at_hand(
    file: &MapFile,
    path: PathBuf,
    missing: &mut Vec<String>,
    digests: &mut Digests,
) -> Result<At, Error> {
    let shown = path.display().to_string();
    if !path.is_file() {
        missing.push(shown.clone());
        return Ok(At { shown, path: None });
    }
    file.check(&shown, &digests.of(&path)?)?;
    Ok(At { shown, path: Some(path) })
}

fn fil_lines(
    file: &MapFile,
    path: &Path,
    options: &Options,
    missing: &mut Vec<String>,
) -> Result<Option<Vec<String>>, Error> {
    let shown = path.display().to_string();
    if !path.is_file() {
        missing.push(shown);
        return Ok(None);
    }
    let text = files::read_text(path, options.encoding.as_deref())?;
    file.check(&shown, &Digest::of(text.as_bytes()))?;
    Ok(Some(text.lines().map(str::to_string).collect()))
}

/// A path without `folder/..`.
fn tidy(path: &Path) -> PathBuf {
    let mut parts = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir
                if matches!(parts.components().next_back(), Some(Component::Normal(_))) =>
            {
                parts.pop();
            }
            part => parts.push(part),
        }
    }
    parts
}
