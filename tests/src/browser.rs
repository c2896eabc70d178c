//! A headless browser: Debian's chromium.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;
use std::{env, fs};

/// Keeps the browser from asking anything of anybody.
const QUIET: &[&str] = &[
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--hide-scrollbars",
    "--window-size=1200,800",
];

/// The browser: `FILPOST_CHROMIUM`, else on the PATH. `None`, with the reason
/// printed, where it is absent.
pub fn program() -> Option<PathBuf> {
    if let Some(named) = env::var_os("FILPOST_CHROMIUM") {
        return Some(PathBuf::from(named));
    }
    let search = env::var_os("PATH").unwrap_or_default();
    let folders: Vec<PathBuf> = env::split_paths(&search).collect();
    let found = ["chromium", "chromium-browser"]
        .iter()
        .flat_map(|name| folders.iter().map(move |folder| folder.join(name)))
        .find(|file| file.is_file());
    if found.is_none() {
        println!("skipped: no chromium (apt-get install chromium)");
    }
    found
}

fn command(program: &Path, folder: &Path) -> Command {
    let mut command = Command::new(program);
    command
        .current_dir(folder)
        .env("HOME", folder)
        .args(QUIET)
        .arg(format!("--user-data-dir={}", folder.join("profile").display()))
        .stdin(Stdio::null());
    command
}

fn run(program: &Path, folder: &Path, arguments: &[String]) -> Result<Vec<u8>, String> {
    let output = command(program, folder)
        .args(arguments)
        .output()
        .map_err(|error| format!("{}: {error}", program.display()))?;
    if output.status.success() {
        Ok(output.stdout)
    } else {
        Err(String::from_utf8_lossy(&output.stderr).into_owned())
    }
}

/// The page as it is after its scripts have run for `seconds`.
///
/// # Errors
/// Why the browser could not be run.
pub fn dom(program: &Path, page: &str, seconds: u32) -> Result<String, String> {
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let file = folder.path().join("page.html");
    fs::write(&file, page).map_err(|error| error.to_string())?;
    let arguments = [
        "--dump-dom".to_string(),
        format!("--virtual-time-budget={}", seconds * 1000),
        format!("file://{}", file.display()),
    ];
    let dom = run(program, folder.path(), &arguments)?;
    Ok(String::from_utf8_lossy(&dom).into_owned())
}

/// The JSON that a page writes to the console after `said: `, in real time.
///
/// # Errors
/// Why the browser could not be run, or that the page said nothing in `seconds`.
pub fn said(program: &Path, page: &str, seconds: u64) -> Result<String, String> {
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let file = folder.path().join("page.html");
    fs::write(&file, page).map_err(|error| error.to_string())?;
    let mut child = command(program, folder.path())
        .args(["--enable-logging=stderr", "--log-level=0"])
        .arg(format!("file://{}", file.display()))
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| format!("{}: {error}", program.display()))?;
    let log = child.stderr.take().ok_or("no log")?;
    let (tell, told) = std::sync::mpsc::channel();
    let reader = std::thread::spawn(move || {
        let lines = BufReader::new(log).split(b'\n').map_while(Result::ok);
        let texts = lines.map(|line| String::from_utf8_lossy(&line).into_owned());
        let mut said = texts.filter_map(|text| Some(text.split_once("\"said: ")?.1.to_string()));
        // Who asked may have given up.
        let _ = said.next().map(|text| tell.send(text));
    });
    let said = told.recv_timeout(Duration::from_secs(seconds));
    let ended = child.kill().and_then(|()| child.wait());
    ended.map_err(|error| error.to_string())?;
    let _ = reader.join();
    let text = said.map_err(|_| format!("the page said nothing in {seconds} seconds"))?;
    Ok(text.rsplit_once("\", source:").map_or(text.clone(), |(text, _)| text.to_string()))
}

/// A screenshot of a file (its ending says what it is) as rows of RGB.
///
/// # Errors
/// Why there is none.
pub fn screenshot(program: &Path, name: &str, text: &str) -> Result<Vec<[u8; 3]>, String> {
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let file = folder.path().join("picture.png");
    picture(program, name, text, &file)?;
    pixels(&file)
}

/// The same as a PNG file.
///
/// # Errors
/// Why there is none.
pub fn picture(program: &Path, name: &str, text: &str, to: &Path) -> Result<(), String> {
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let file = folder.path().join(name);
    fs::write(&file, text).map_err(|error| error.to_string())?;
    let arguments = [
        format!("--screenshot={}", to.display()),
        "--virtual-time-budget=3000".to_string(),
        format!("file://{}", file.display()),
    ];
    run(program, folder.path(), &arguments).map(|_| ())
}

fn pixels(picture: &Path) -> Result<Vec<[u8; 3]>, String> {
    let file = fs::File::open(picture).map_err(|error| error.to_string())?;
    let decoder = png::Decoder::new(std::io::BufReader::new(file));
    let mut reader = decoder.read_info().map_err(|error| error.to_string())?;
    let size = reader.output_buffer_size().ok_or("a picture too large")?;
    let mut bytes = vec![0; size];
    let frame = reader.next_frame(&mut bytes).map_err(|error| error.to_string())?;
    let samples = frame.color_type.samples();
    Ok(bytes[..frame.buffer_size()]
        .chunks(samples)
        .map(|pixel| [pixel[0], pixel[1], pixel[2]])
        .collect())
}

/// How many pixels are about of a colour, `#rrggbb`.
pub fn count(pixels: &[[u8; 3]], colour: &str) -> usize {
    let part = |at: usize| u8::from_str_radix(&colour[at..at + 2], 16).unwrap_or(0);
    let wanted = [part(1), part(3), part(5)];
    let near = |pixel: &&[u8; 3]| pixel.iter().zip(wanted).all(|(a, b)| a.abs_diff(b) < 40);
    pixels.iter().filter(near).count()
}
