//! Nests the flat statements: sections, macros and blocks.

use fil_diag::Diag;

use crate::errors::SyntaxCode;
use crate::flat::{Flat, FlatKind};
use crate::frame::{Frame, FrameKind};
use crate::reader::Reader;
use crate::tree::{Expr, Item, Macro, Name, Program, Section, SectionKey, Span, Stmt, StmtKind};

/// How deep blocks may stand inside each other.
const MAX_BLOCKS: usize = 100;

/// Makes a tree of statements.
pub(crate) fn nest(reader: &mut Reader<'_>, statements: Vec<Flat>) -> Program {
    let mut nester = Nester {
        reader,
        items: Vec::new(),
        area: Area::Global,
        body: Vec::new(),
        frames: Vec::new(),
        left_open: Vec::new(),
        finished: false,
        too_deep: false,
    };
    for statement in statements {
        nester.take(statement);
        if nester.too_deep {
            break;
        }
    }
    nester.finish();
    Program { items: nester.items }
}

/// What is open outside of all blocks.
enum Area {
    Global,
    Section { key: SectionKey, span: Span },
    Macro { name: Name, params: Vec<(Name, Option<Expr>)>, span: Span },
}

impl Area {
    fn span(&self) -> Option<Span> {
        match self {
            Area::Global => None,
            Area::Section { span, .. } | Area::Macro { span, .. } => Some(*span),
        }
    }

    fn noun(&self) -> &'static str {
        match self {
            Area::Global => "global area",
            Area::Section { .. } => "section",
            Area::Macro { .. } => "macro",
        }
    }
}

struct Nester<'r, 'a> {
    reader: &'r mut Reader<'a>,
    items: Vec<Item>,
    area: Area,
    /// Statements of the open section or macro.
    body: Vec<Stmt>,
    /// Open blocks, the innermost last.
    frames: Vec<Frame>,
    /// Opening lines of the blocks that the end of the section closed.
    left_open: Vec<Span>,
    finished: bool,
    /// Blocks got too deep and nesting was given up, which also bounds the time
    /// it takes to look through the open ones.
    too_deep: bool,
}

impl Nester<'_, '_> {
    fn take(&mut self, flat: Flat) {
        let Flat { label, kind, span } = flat;
        match kind {
            FlatKind::Plain(StmtKind::Fini) => self.fini(label, span),
            FlatKind::Plain(kind) => self.add(Stmt { label, kind, span }),
            FlatKind::Refused => self.add(Stmt { label, kind: StmtKind::Contin, span }),
            FlatKind::If(condition) => self.open(FrameKind::if_then(condition), label, span),
            FlatKind::Do { label: end, variable, range } => {
                let shared = self.shares_label(&end);
                let kind = FrameKind::Do { label: end, variable, range };
                self.open(kind, label, span);
                if let Some(frame) = self.frames.last_mut() {
                    frame.reported |= shared;
                }
            }
            FlatKind::Case(subject) => self.open(FrameKind::case(subject), label, span),
            FlatKind::ElseIf(_) | FlatKind::Else | FlatKind::When(_) | FlatKind::WhenOther => {
                self.no_label(label);
                self.part(kind, span);
            }
            FlatKind::EndIf => self.end("ENDIF", FrameKind::is_if, label, span),
            FlatKind::EndCase => self.end("ENDCAS", FrameKind::is_case, label, span),
            FlatKind::SectionOn(key) => self.open_area(Area::Section { key, span }, label, span),
            FlatKind::Macro { name, params } => {
                self.open_area(Area::Macro { name, params, span }, label, span);
            }
            FlatKind::SectionOff => self.section_off(label, span),
            FlatKind::MacroEnd => self.macro_end(label, span),
        }
    }

    /// Adds a statement where we are; a DO may end with it.
    fn add(&mut self, stmt: Stmt) {
        let label = stmt.label.clone();
        self.add_inside(stmt);
        if let Some(label) = label {
            self.end_do(&label);
        }
    }

    fn add_inside(&mut self, stmt: Stmt) {
        let Some(frame) = self.frames.last_mut() else {
            match self.area {
                Area::Global => self.items.push(Item::Stmt(stmt)),
                _ => self.body.push(stmt),
            }
            return;
        };
        if frame.before_first_when() {
            let message = "this statement is between CASE and its first WHEN".to_string();
            let opened = ("of this CASE".to_string(), frame.span);
            self.unbalanced(SyntaxCode::BeforeWhen, message, stmt.span, Some(opened));
        } else {
            frame.body.push(stmt);
        }
    }

    /// Closes the DO that ends with a statement of this label.
    fn end_do(&mut self, label: &Name) {
        while self.frames.last().is_some_and(|frame| frame.kind.ends_at(label)) {
            self.close_last();
        }
        let inner = self.frames.last().map(|frame| (frame.kind.word(), frame.span));
        let waiting = self.frames.iter_mut().find(|frame| frame.awaits(label));
        if let (Some((word, span)), Some(frame)) = (inner, waiting) {
            frame.reported = true;
            self.unbalanced(
                SyntaxCode::WrongDoEnd,
                format!("the label {} of DO is inside another block", label.text),
                label.span,
                Some((format!("inside this {word}"), span)),
            );
        }
    }

    /// Two DO cannot end together; true when that was reported.
    fn shares_label(&mut self, label: &Name) -> bool {
        let other = self.frames.iter().find(|frame| frame.kind.ends_at(label));
        let Some(span) = other.map(|frame| frame.span) else { return false };
        self.unbalanced(
            SyntaxCode::WrongDoEnd,
            format!("two open DO share the label {}", label.text),
            label.span,
            Some(("the first one".to_string(), span)),
        );
        true
    }

    fn open(&mut self, kind: FrameKind, label: Option<Name>, span: Span) {
        if self.frames.len() == MAX_BLOCKS {
            let message = format!("more than {MAX_BLOCKS} blocks inside each other");
            self.reader.report(SyntaxCode::TooDeep, message, span);
            self.too_deep = true;
            return;
        }
        if let Some(label) = &label
            && let Some(frame) = self.frames.iter_mut().find(|frame| frame.awaits(label))
        {
            frame.reported = true;
            let message = format!("DO cannot end at {}, which opens a block", kind.word());
            self.reader.report(SyntaxCode::WrongDoEnd, message, label.span);
            self.end_do(label);
        }
        self.frames.push(Frame { kind, label, span, body: Vec::new(), reported: false });
    }

    /// ELSEIF, ELSE and WHEN: a further part of the innermost IF or CASE.
    fn part(&mut self, kind: FlatKind, span: Span) {
        let (word, of): (_, fn(&FrameKind) -> bool) = match kind {
            FlatKind::ElseIf(_) => ("ELSEIF", FrameKind::is_if),
            FlatKind::Else => ("ELSE", FrameKind::is_if),
            _ => ("WHEN", FrameKind::is_case),
        };
        if !self.close_down_to(word, of, span) {
            return;
        }
        let Some(frame) = self.frames.last_mut() else { return };
        let opened = frame.span;
        if !frame.next_part(kind, span) {
            let message = format!("{word} follows the branch for all other cases");
            let opened = ("of this block".to_string(), opened);
            self.unbalanced(SyntaxCode::AfterLast, message, span, Some(opened));
        }
    }

    /// ENDIF and ENDCAS. A label on them leads to what follows the block.
    fn end(&mut self, word: &str, of: fn(&FrameKind) -> bool, label: Option<Name>, span: Span) {
        if !self.close_down_to(word, of, span) {
            return;
        }
        self.close_last();
        self.add_label(label, span);
    }

    fn add_label(&mut self, label: Option<Name>, span: Span) {
        if label.is_some() {
            self.add(Stmt { label, kind: StmtKind::Contin, span });
        }
    }

    /// Makes the innermost block of a kind the last one: blocks inside it that
    /// are still open are reported. False when there is no such block.
    fn close_down_to(&mut self, word: &str, of: fn(&FrameKind) -> bool, span: Span) -> bool {
        let Some(at) = self.frames.iter().rposition(|frame| of(&frame.kind)) else {
            let message = format!("{word} without the line that opens its block");
            self.unbalanced(SyntaxCode::StrayWord, message, span, None);
            return false;
        };
        self.close_inside(at + 1, word, span);
        true
    }

    /// Reports and closes all blocks but the outer `keep`, because of a word
    /// they should have been closed before.
    fn close_inside(&mut self, keep: usize, word: &str, span: Span) {
        while self.frames.len() > keep {
            self.report_open(SyntaxCode::UnclosedBlock, word, span);
            self.close_last();
        }
    }

    /// Closes the blocks of a section that ends, and gives the opening lines of those
    /// that may end there. A DO may not: without its label its last statement is
    /// unknown, and with it how often the others run.
    fn close_by_section(&mut self, span: Span) -> Vec<Span> {
        let mut left_open = Vec::new();
        while let Some(frame) = self.frames.last() {
            let is_do = matches!(frame.kind, FrameKind::Do { .. });
            let code = if is_do { SyntaxCode::UnclosedBlock } else { SyntaxCode::ClosedBySection };
            left_open.extend((!is_do).then_some(frame.span));
            self.report_open(code, "CIMFIL/OFF", span);
            self.close_last();
        }
        left_open
    }

    /// Reports the innermost block, still open at a word, unless that is done.
    fn report_open(&mut self, code: SyntaxCode, word: &str, span: Span) {
        if let Some(frame) = self.frames.last().filter(|frame| !frame.reported) {
            let message = format!("{} is not closed", frame.kind.describe());
            let (opened, other) = (frame.span, format!("still open at {word}"));
            self.unbalanced(code, message, opened, Some((other, span)));
        }
    }

    /// Closes the innermost block.
    fn close_last(&mut self) {
        if let Some(frame) = self.frames.pop() {
            self.add_inside(frame.close());
        }
    }

    fn open_area(&mut self, area: Area, label: Option<Name>, span: Span) {
        self.no_label(label);
        let word = if matches!(area, Area::Macro { .. }) { "MACRO" } else { "CIMFIL/ON" };
        self.close_inside(0, word, span);
        if let Some(opened) = self.area.span() {
            self.unbalanced(
                SyntaxCode::NestedArea,
                format!("{word} inside a {}", self.area.noun()),
                span,
                Some(("still open".to_string(), opened)),
            );
            self.close_area(span);
        }
        self.area = area;
    }

    fn section_off(&mut self, label: Option<Name>, span: Span) {
        if !matches!(self.area, Area::Section { .. }) {
            let message = "CIMFIL/OFF without CIMFIL/ON";
            return self.unbalanced(SyntaxCode::StrayWord, message.to_string(), span, None);
        }
        self.left_open = self.close_by_section(span);
        self.add_label(label, span);
        self.close_area(span);
    }

    fn macro_end(&mut self, label: Option<Name>, span: Span) {
        if !matches!(self.area, Area::Macro { .. }) {
            let message = "TERMAC without MACRO";
            return self.unbalanced(SyntaxCode::StrayWord, message.to_string(), span, None);
        }
        self.close_inside(0, "TERMAC", span);
        self.add_label(label, span);
        self.close_area(span);
    }

    fn close_area(&mut self, end: Span) {
        let body = std::mem::take(&mut self.body);
        match std::mem::replace(&mut self.area, Area::Global) {
            Area::Global => {}
            Area::Section { key, span } => {
                let span = Span { start: span.start, end: end.end };
                let left_open = std::mem::take(&mut self.left_open);
                self.items.push(Item::Section(Section { key, body, left_open, span }));
            }
            Area::Macro { name, params, span } => {
                let span = Span { start: span.start, end: end.end };
                self.items.push(Item::Macro(Macro { name, params, body, span }));
            }
        }
    }

    fn fini(&mut self, label: Option<Name>, span: Span) {
        self.close_everything("FINI", span);
        self.add(Stmt { label, kind: StmtKind::Fini, span });
        self.finished = true;
    }

    fn close_everything(&mut self, word: &str, span: Span) {
        self.close_inside(0, word, span);
        if let Some(opened) = self.area.span() {
            let message = format!("this {} is not closed", self.area.noun());
            let place = Some((format!("still open at {word}"), span));
            self.unbalanced(SyntaxCode::UnclosedArea, message, opened, place);
            self.close_area(span);
        }
    }

    /// The end of the text.
    fn finish(&mut self) {
        let end = self.reader.end_span();
        self.close_everything("the end of the file", end);
        if !self.finished && !self.too_deep && !self.reader.stopped() {
            let message = "the file does not end with FINI";
            self.reader.report(SyntaxCode::MissingFini, message, end);
        }
    }

    fn no_label(&mut self, label: Option<Name>) {
        if let Some(label) = label {
            let message = format!("the label {} is not allowed before this word", label.text);
            self.reader.report(SyntaxCode::WrongLabel, message, label.span);
        }
    }

    /// Reports blocks that do not fit together, with the second place. When a
    /// statement could not be read, it may have been the missing half: that one
    /// is reported, guesses are not.
    fn unbalanced(
        &mut self,
        code: SyntaxCode,
        message: String,
        span: Span,
        other: Option<(String, Span)>,
    ) {
        if self.too_deep || self.reader.unreadable || self.reader.stopped() {
            return;
        }
        let mut diag = Diag::new(code, message).at(self.reader.place(span));
        if let Some((label, span)) = other {
            diag = diag.at(self.reader.place(span).label(label));
        }
        self.reader.push(diag);
    }
}
