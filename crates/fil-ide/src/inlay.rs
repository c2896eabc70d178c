//! Hints inside the text: what a number stands for.

use filpost::postf::POSTF;
use filpost::resolve::SymbolKind;

use crate::context::postf_calls;
use crate::script::Script;
use crate::tables;
use crate::text::Position;

/// A hint behind a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Inlay {
    /// Right behind this place.
    pub position: Position,
    /// Its text.
    pub label: String,
}

/// Words 6 to 11 of a motion record.
const POINT: [&str; 6] = ["x", "y", "z", "i", "j", "k"];
const FIRST_COORDINATE: u32 = 6;

impl Script {
    /// Operations of POSTF, names of commons, coordinates of motion records.
    pub fn inlays(&self) -> Vec<Inlay> {
        let text = self.text.as_str();
        let mut found = Vec::new();
        for call in postf_calls(&self.text) {
            let number =
                |index: usize| text.get(call.arguments.get(index)?.clone())?.parse::<u32>().ok();
            let behind = |index: usize| self.text.position(call.arguments[index].end);
            let Some(operation) = number(0) else { continue };
            let row = POSTF.iter().find(|row| u32::from(row.number) == operation);
            if let Some(row) = row {
                let label = format!(": {}", filpost::operation_name(row.op));
                found.push(Inlay { position: behind(0), label });
            }
            let more = match (operation, number(1), number(2)) {
                (1..=3, Some(kind), Some(common)) => {
                    tables::common_name(kind, common).map(|name| (2, name))
                }
                (7 | 8, Some(word), _) if self.in_motion(call.arguments[0].start) => {
                    let at = word.checked_sub(FIRST_COORDINATE);
                    at.and_then(|at| POINT.get(at as usize)).map(|name| (1, (*name).to_string()))
                }
                _ => None,
            };
            if let Some((index, name)) = more {
                found.push(Inlay { position: behind(index), label: format!(": {name}") });
            }
        }
        found
    }

    /// True inside of a section for GOTO, FROM or GODLTA, whose words have one order.
    fn in_motion(&self, byte: usize) -> bool {
        self.section_at(byte).is_some_and(|name| {
            let major = name.split(',').next().unwrap_or_default();
            ["GOTO", "FROM"].contains(&major)
        })
    }

    /// The key of the section around a byte.
    pub(crate) fn section_at(&self, byte: usize) -> Option<&str> {
        let sections = self.analysis.resolution.of_kind(SymbolKind::Section);
        let mut around = sections.filter(|section| {
            section.extent.is_some_and(|extent| {
                extent.file == self.file && extent.span.range().contains(&byte)
            })
        });
        around.next().map(|section| section.name.as_str())
    }
}
