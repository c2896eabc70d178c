//! Names of documents: `file:` URIs and paths.

use std::path::{Path, PathBuf};

use filpost::files;

/// The path of a `file:` URI; `None` for another scheme.
pub(crate) fn path_of(uri: &str) -> Option<PathBuf> {
    path_on(uri, cfg!(windows))
}

fn path_on(uri: &str, windows: bool) -> Option<PathBuf> {
    let rest = uri.strip_prefix("file://")?;
    let (host, rest) = rest.split_at(rest.find('/')?);
    let mut bytes = Vec::with_capacity(rest.len());
    let mut left = rest.bytes();
    while let Some(byte) = left.next() {
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let digits = [left.next()?, left.next()?];
        let digits = std::str::from_utf8(&digits).ok()?;
        bytes.push(u8::from_str_radix(digits, 16).ok()?);
    }
    let path = String::from_utf8(bytes).ok()?;
    // file:///C:/…
    let drive = path.as_bytes().get(2) == Some(&b':') && windows;
    // file://server/share/…
    let share = windows && !host.is_empty() && host != "localhost";
    Some(match (drive, share) {
        (true, _) => PathBuf::from(&path[1..]),
        (_, true) => PathBuf::from(format!("//{host}{path}")),
        _ => PathBuf::from(path),
    })
}

/// The URI of a path.
pub(crate) fn uri_of(path: &Path) -> String {
    let mut uri = String::from("file://");
    let text = files::plain(path.to_path_buf()).display().to_string().replace('\\', "/");
    if !text.starts_with('/') {
        uri.push('/');
    }
    for byte in text.bytes() {
        if byte.is_ascii_alphanumeric() || b"/-_.~:".contains(&byte) {
            uri.push(char::from(byte));
        } else {
            uri.push_str(&format!("%{byte:02X}"));
        }
    }
    uri
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_comes_back_from_its_uri() {
        for path in ["/work/a b/Пост.fil", "/x/100%.fil", "/uncx01.f01"] {
            let path = Path::new(path);
            assert_eq!(path_of(&uri_of(path)).as_deref(), Some(path));
        }
        assert_eq!(path_of("untitled:Untitled-1"), None);
        assert_eq!(path_of("file:///a%2"), None);
        assert_eq!(path_of("file:///a%zz"), None);
    }

    #[test]
    fn drives_and_shares_of_windows_have_their_paths() {
        let path = |uri| path_on(uri, true).map(|path| path.display().to_string());
        assert_eq!(path("file:///c%3A/posts/a.fil").as_deref(), Some("c:/posts/a.fil"));
        assert_eq!(path("file:///C:/posts/a%20b.fil").as_deref(), Some("C:/posts/a b.fil"));
        assert_eq!(path("file://server/share/a.fil").as_deref(), Some("//server/share/a.fil"));
        assert_eq!(path("file://localhost/C:/a.fil").as_deref(), Some("C:/a.fil"));
    }

    #[test]
    fn real_paths_of_windows_have_the_uri_that_an_editor_knows() {
        let uri = |path: &str| uri_of(Path::new(path));
        assert_eq!(uri(r"\\?\C:\posts\a b.fil"), "file:///C:/posts/a%20b.fil");
        assert_eq!(uri(r"C:\posts\a.fil"), "file:///C:/posts/a.fil");
    }
}
