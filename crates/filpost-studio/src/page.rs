//! The files of the page, as `.ci/studio` has built them.

/// A file of the page: its name in the address, its kind, its bytes.
struct File(&'static str, &'static str, &'static [u8]);

const FILES: [File; 4] = [
    File("", "text/html; charset=utf-8", include_bytes!("../page/dist/index.html")),
    File("studio.js", "text/javascript; charset=utf-8", include_bytes!("../page/dist/studio.js")),
    File("view.js", "text/javascript; charset=utf-8", include_bytes!("../page/dist/view.js")),
    File("studio.css", "text/css; charset=utf-8", include_bytes!("../page/dist/studio.css")),
];

/// Kind and bytes of a file of the page.
pub(crate) fn file(name: &str) -> Option<(&'static str, &'static [u8])> {
    FILES.iter().find(|file| file.0 == name).map(|file| (file.1, file.2))
}
