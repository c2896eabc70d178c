//! Breaks a statement into lines.

use super::pieces::{Break, Piece};

/// The columns of a line; comments may stand beyond them.
pub(super) const WIDTH: usize = 72;

/// Blanks before the continued lines of a statement, beyond its own.
const CONTINUED: usize = 4;

/// The sign of a line that goes on.
const GOES_ON: &str = " $";

/// The lines of a statement, without the indentation of the first one.
pub(super) fn lines(pieces: &[Piece], indent: usize) -> Vec<String> {
    let mut lines = Vec::new();
    let continued = " ".repeat(indent + CONTINUED);
    let mut start = 0;
    while start < pieces.len() {
        let first = lines.is_empty();
        let used = if first { indent } else { indent + CONTINUED };
        let stop = line_stop(pieces, start, WIDTH.saturating_sub(used));
        let mut line = if first { String::new() } else { continued.clone() };
        line.push_str(&joined(&pieces[start..stop]));
        if let Some(next) = pieces.get(stop) {
            line.push_str(GOES_ON);
            lines.push(line);
            add_comments(&mut lines, &next.comments, &continued);
        } else {
            lines.push(line);
        }
        start = stop;
    }
    lines
}

/// Comments stand behind the `$`, one a line.
fn add_comments(lines: &mut Vec<String>, comments: &[String], continued: &str) {
    for (index, comment) in comments.iter().enumerate() {
        if index > 0 {
            lines.push(format!("{continued}{}", GOES_ON.trim_start()));
        }
        if let Some(line) = lines.last_mut() {
            line.push_str("  ");
            line.push_str(comment);
        }
    }
}

/// Where the line that starts with a piece ends: at the best break that fits,
/// or else at the first one there is.
fn line_stop(pieces: &[Piece], start: usize, room: usize) -> usize {
    let mut width = 0;
    let mut best: Option<(Break, usize)> = None;
    for (at, piece) in pieces.iter().enumerate().skip(start) {
        let breakable = at > start && piece.before != Break::Never;
        let fits = width + GOES_ON.len() <= room;
        if breakable {
            let known = best.map(|(known, _)| known);
            if known.is_none_or(|known| fits && piece.before >= known) {
                best = Some((piece.before, at));
            }
            if piece.before == Break::Always {
                break;
            }
        }
        width += piece.text.chars().count() + usize::from(piece.blank && at > start);
        if width > room && best.is_some() {
            break;
        }
        if at + 1 == pieces.len() {
            return pieces.len();
        }
    }
    best.map_or(pieces.len(), |(_, stop)| stop)
}

/// Pieces as one line.
fn joined(pieces: &[Piece]) -> String {
    let mut text = String::new();
    for piece in pieces {
        if piece.blank && !text.is_empty() {
            text.push(' ');
        }
        text.push_str(&piece.text);
    }
    text
}
