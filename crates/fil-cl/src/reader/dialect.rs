//! The families of CL text and how to tell them apart.

/// Who wrote a CL text. The lexical rules are common; the families differ in
/// the sense of a circle's axis and in the tool axis of a GOTO.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dialect {
    /// PTC Creo, Pro/ENGINEER: right-hand circles with radius, axis only as written.
    Creo,
    /// Siemens NX CLSF: left-hand circles, the tool axis is modal.
    Nx,
    /// SolidWorks CAM, CAMWorks: right-hand circles without radius.
    SolidWorksCam,
    /// NCCS NCL: the tool axis is modal while MULTAX is on.
    Ncl,
}

/// First words of a line that only one family writes.
const OPENINGS: [(&[u8], Dialect); 10] = [
    (b"$$->", Dialect::Creo),
    (b"TOOL PATH/", Dialect::Nx),
    (b"TLDATA/", Dialect::Nx),
    (b"MSYS/", Dialect::Nx),
    (b"PAINT/", Dialect::Nx),
    (b"END-OF-PATH", Dialect::Nx),
    (b"CSI_SET_", Dialect::SolidWorksCam),
    (b"TRNTYP/", Dialect::SolidWorksCam),
    (b"OPFEATSTART/", Dialect::SolidWorksCam),
    (b"MOVE_ATTRIB/", Dialect::SolidWorksCam),
];

impl Dialect {
    /// The family of a text, from its first lines; the first line that tells
    /// decides, and a text without such a line is read as Creo's.
    pub fn detect(head: &[u8]) -> Dialect {
        head.split(|byte| *byte == b'\n').find_map(of_line).unwrap_or(Dialect::Creo)
    }

    /// True when a circle's axis is opposite to the right-hand rule.
    pub(super) fn turns_circles(self) -> bool {
        self == Dialect::Nx
    }

    /// True when six values of a GOTO are always a point and a tool axis.
    pub(super) fn writes_axes(self) -> bool {
        self != Dialect::Creo
    }

    /// True when a GOTO without tool axis keeps the last one.
    pub(super) fn keeps_axis(self, multax: bool) -> bool {
        match self {
            Dialect::Nx => true,
            Dialect::Ncl => multax,
            Dialect::Creo | Dialect::SolidWorksCam => false,
        }
    }
}

fn of_line(line: &[u8]) -> Option<Dialect> {
    if line.starts_with(b"$$*") && contains(line, b"Pro/CLfile") {
        return Some(Dialect::Creo);
    }
    if line.starts_with(b"REMARK") && contains(line, b"NCLCAM") {
        return Some(Dialect::Ncl);
    }
    let opening = OPENINGS.iter().find(|(opening, _)| line.starts_with(opening));
    opening.map(|(_, dialect)| *dialect)
}

fn contains(line: &[u8], text: &[u8]) -> bool {
    memchr::memmem::find(line, text).is_some()
}
