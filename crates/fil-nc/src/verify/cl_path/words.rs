//! Major words of a CL file, and what each of them means for the path: one row a word.

use fil_cl::{Record, Vocabulary, WordId, words as w};

use super::{State, own_words};
use crate::motion::Speed;
use crate::verify::expected_step::{Effect, End, ExpectedStep};
use crate::verify::statements::{
    compensation, coolant, numbers, plane_of_compensation, spindle, statement, whole,
};

type Steps = Vec<ExpectedStep>;

/// What words of the user's own leave open, and a step.
type OwnStep = (Option<Effect>, Option<ExpectedStep>);

/// How a word is read.
#[derive(Clone, Copy)]
pub(super) enum Reading {
    /// Its steps.
    Steps(fn(&mut State, &Record) -> Steps),
    /// The same, where its form or the machine makes them certain; else what it leaves open.
    Or(Effect, fn(&mut State, &Record) -> Option<Steps>),
    /// Words of the user's own.
    Own(fn(&State, &Record, &Vocabulary) -> OwnStep),
    /// Its steps, as the machine means it, else it leaves the path open; none where the machine
    /// lists it as without effect.
    Chosen(fn(&mut State, &Record) -> Option<Steps>),
    /// It changes the path or the frame by rules that are not public, unless the machine lists it
    /// as without effect.
    EndsThePath,
    /// Its record has a kind of its own, which is read before words are.
    ByKind,
    /// No step: why the program need not show it.
    Ignored(&'static str),
}

use Reading::{ByKind, Chosen, EndsThePath, Ignored, Or, Own, Steps as S};

const COMMENT: &str = "its text is a comment, which moves and switches nothing";
const NO_PROGRAM: &str = "the post refuses the record, so no program comes of it";

/// The words that the verifier knows.
pub(super) const WORDS: &[(WordId, Reading)] = &[
    (w::FEDRAT, S(State::feed)),
    (w::RAPID, S(State::rapid)),
    (w::SPINDL, S(State::spindle)),
    (w::COOLNT, Or(Effect::Words, |_, record| Some(vec![coolant(record)?]))),
    (w::LOADTL, Or(Effect::Words, State::tool)),
    (w::LOAD, Or(Effect::Words, State::tool)),
    (w::TURRET, Or(Effect::Words, State::tool)),
    (w::CUTTER, S(State::cutter)),
    (w::CUTCOM, Or(Effect::Words, |_, record| cutter_compensation(record))),
    (w::CYCLE, Or(Effect::Path, State::cycle)),
    (w::DELAY, S(|_, record| vec![dwell(record)])),
    (w::GOHOME, Or(Effect::Path, State::home)),
    (w::RETRCT, S(State::retract)),
    (w::UNITS, S(State::units)),
    (w::UNIT, S(State::units)),
    (w::TRANS, S(State::trans)),
    (w::ORIGIN, Chosen(State::origin)),
    (w::TRACUT, Chosen(State::tracut)),
    (w::ROTABL, Chosen(State::table)),
    (w::ROTATE, Chosen(State::table)),
    (w::PITCH, Or(Effect::Path, State::pitch)),
    (w::OP, Or(Effect::Path, State::thread)),
    (w::THREAD, Or(Effect::Path, State::thread)),
    (w::LINTOL, S(State::straight)),
    (w::MODE, S(|_, record| mode(record))),
    (w::PREFUN, Own(|state, record, _| state.preparatory(record))),
    (w::AUXFUN, Or(Effect::Auxiliary, |state, record| state.auxiliary(record))),
    (w::CLAMP, S(|_, record| vec![ExpectedStep::Clamp(record.has(w::ON))])),
    (w::SET, Chosen(|_, record| Some(offset_by_number(record)))),
    (w::STOP, S(|_, _| vec![ExpectedStep::Stop { optional: false }])),
    (w::OPSTOP, S(|_, _| vec![ExpectedStep::Stop { optional: true }])),
    (w::INSERT, S(State::insert)),
    (w::POSTN, Own(|_, record, vocabulary| own_words::once(record, vocabulary))),
    (w::REPEAT, Own(|_, record, vocabulary| own_words::repeated(record, vocabulary))),
    (w::END, S(|_, _| vec![ExpectedStep::End(End::Stay)])),
    (w::REWIND, S(|_, _| vec![ExpectedStep::End(End::Rewind)])),
    (w::CALSUB, EndsThePath),
    (w::COPY, EndsThePath),
    (w::DEFSUB, EndsThePath),
    (w::ENDSUB, EndsThePath),
    (w::HEAD, EndsThePath),
    (w::INDEX, EndsThePath),
    (w::ROTHED, EndsThePath),
    (w::CIRCLE, ByKind),
    (w::FINI, ByKind),
    (w::FROM, ByKind),
    (w::GODLTA, ByKind),
    (w::GOTO, ByKind),
    (w::MULTAX, ByKind),
    (w::OPSKIP, ByKind),
    (w::TLAXIS, ByKind),
    (w::ARCSLP, Ignored("arcs are compared as arcs, however the post writes them")),
    (w::PARTNO, Ignored(COMMENT)),
    (w::PLABEL, Ignored(COMMENT)),
    (w::PPRINT, Ignored(COMMENT)),
    (w::REPLAC, Ignored("it changes letters of the program, which is compared as it is")),
    (w::SELCTL, Ignored("it prepares a tool, and the change after it is compared")),
    (w::SELECT, Ignored("it prepares a tool, and the change after it is compared")),
    (w::SEQNO, Ignored("it numbers blocks, which moves and switches nothing")),
    (w::SWITCH, Ignored(NO_PROGRAM)),
    (w::SYNC, Ignored(NO_PROGRAM)),
];

/// How a word is read; `None` for one that the verifier does not know.
fn reading(word: WordId) -> Option<Reading> {
    WORDS.iter().find(|(known, _)| *known == word).map(|(_, reading)| *reading)
}

/// Whether the verifier has a row for a major word of the CL file.
pub fn knows_word(word: WordId) -> bool {
    reading(word).is_some()
}

/// The words that no step comes of, and why.
pub fn ignored_words() -> impl Iterator<Item = (WordId, &'static str)> {
    WORDS.iter().filter_map(|(word, reading)| match reading {
        Ignored(why) => Some((*word, *why)),
        _ => None,
    })
}

impl State {
    /// The steps of a post command.
    pub(super) fn command(&mut self, record: &Record, vocabulary: &Vocabulary) -> Steps {
        let open = |effect| ExpectedStep::Unknown { what: statement(record, vocabulary), effect };
        match reading(record.major) {
            Some(Chosen(_) | EndsThePath)
                if self.frame.words.is_without_effect(vocabulary.name(record.major)) =>
            {
                Vec::new()
            }
            Some(Chosen(steps)) => steps(self, record).unwrap_or_else(|| vec![open(Effect::Path)]),
            Some(S(steps)) => steps(self, record),
            Some(Or(effect, steps)) => steps(self, record).unwrap_or_else(|| vec![open(effect)]),
            Some(Own(words)) => {
                let (effect, step) = words(self, record, vocabulary);
                effect.map(open).into_iter().chain(step).collect()
            }
            Some(EndsThePath) => vec![open(Effect::Path)],
            Some(ByKind | Ignored(_)) | None => Vec::new(),
        }
    }

    fn auxiliary(&self, record: &Record) -> Option<Steps> {
        let code = numbers(record).first().and_then(|code| whole(*code))?;
        let ends = self.end_codes.contains(&code);
        Some(vec![if ends {
            ExpectedStep::End(End::By(code))
        } else {
            ExpectedStep::Auxiliary(code)
        }])
    }

    fn units(&mut self, record: &Record) -> Steps {
        let unit = super::unit::said(record);
        self.unit = Some(unit);
        vec![ExpectedStep::Metric(unit.is_metric())]
    }

    fn rapid(&mut self, _: &Record) -> Steps {
        self.rapid = true;
        Vec::new()
    }

    fn cutter(&mut self, record: &Record) -> Steps {
        let diameter = numbers(record).first().map(|diameter| diameter * self.unit());
        diameter.map(ExpectedStep::Cutter).into_iter().collect()
    }

    fn feed(&mut self, record: &Record) -> Steps {
        let rate = numbers(record).first().map(|value| self.rate_of(record, *value));
        match rate {
            // Inverse time says the same feed in another way.
            None if record.has(w::INVERS) => return Vec::new(),
            None if record.has(w::LOCK) => {
                return vec![ExpectedStep::OverrideLock(record.has(w::ON))];
            }
            rate => self.rate = rate,
        }
        if let Some(cycle) = self.cycle.as_mut().filter(|cycle| !cycle.has_own_rate) {
            cycle.rate = rate;
            cycle.turns = None;
        }
        self.end_thread();
        Vec::new()
    }

    fn spindle(&mut self, record: &Record) -> Steps {
        self.spindle.is_side = record.has(w::SIDE);
        let steps = spindle(record);
        let speed = steps.iter().find_map(|step| match step {
            ExpectedStep::Speed(speed) => Some(*speed),
            _ => None,
        });
        self.spindle.turns = speed.map_or(self.spindle.turns, Speed::turns);
        steps
    }

    fn home(&mut self, record: &Record) -> Option<Steps> {
        if record.data.is_empty() {
            return Some(self.go_to_machine(ExpectedStep::Home));
        }
        let (point, axis) = match numbers(record)[..] {
            [x, y, z] => ([x, y, z], self.tool.axis),
            [x, y, z, i, j, k] => ([x, y, z], [i, j, k].into()),
            _ => return None,
        };
        Some(vec![self.line_to(point.into(), axis)])
    }

    fn retract(&mut self, record: &Record) -> Steps {
        match record.data.is_empty() {
            true => self.go_to_machine(ExpectedStep::Retract),
            false => Vec::new(),
        }
    }

    fn preparatory(&self, record: &Record) -> OwnStep {
        let code = match numbers(record)[..] {
            [code] if self.frame.chooses_offset(code) => {
                return (None, Some(ExpectedStep::Fixture(code as u32)));
            }
            [code] => code,
            _ => return (Some(own_words::effect(record)), None),
        };
        let step = match (17.0..20.0).contains(&code) {
            true => ExpectedStep::Plane(19 - code as usize),
            // Its mode is that of a text.
            false => ExpectedStep::Words(format!("G{code}")),
        };
        (Some(own_words::effect(record)), Some(step))
    }
}

fn cutter_compensation(record: &Record) -> Option<Steps> {
    let side = compensation(record)?;
    Some([side].into_iter().chain(plane_of_compensation(record)).collect())
}

fn dwell(record: &Record) -> ExpectedStep {
    let amount = numbers(record).first().copied();
    match amount.filter(|_| record.has(w::REV)) {
        Some(turns) => ExpectedStep::DwellTurns(turns),
        None => ExpectedStep::Dwell(amount),
    }
}

fn mode(record: &Record) -> Steps {
    let mode = [(w::TURN, false), (w::MILL, true)].into_iter().find(|(word, _)| record.has(*word));
    mode.map(|(_, mills)| ExpectedStep::Mills(mills)).into_iter().collect()
}

fn offset_by_number(record: &Record) -> Steps {
    let number = numbers(record).first().copied();
    record.has(w::OFSETL).then_some(ExpectedStep::WorkOffset(number)).into_iter().collect()
}
