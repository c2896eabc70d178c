//! The modal groups of the control, as a table: one row a group says what it starts as and what
//! a block that can't be read leaves of it; two alternatives of block delete are joined alike
//! for all of them.

mod usual;

use std::marker::PhantomData;

use fil_machine::FunctionCode;
use fil_machine::functions::WorkPlane;
use fil_machine::modes::{FeedMode, Plane, Unit};

use super::{Compensation, CutterPath, Distance, Length, Rotation, WorkOffset};
pub use usual::GroupSet;
use usual::is_usual;

/// Who made a group unknown, or last wrote it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Nothing in this program has commanded it.
    NotCommanded,
    /// A block that the post wrote.
    Post,
    /// INSERT, POSTN, PREFUN, AUXFUN, a text of the machine, an editing macro.
    Author,
}

/// What is known of a modal group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Know<T> {
    /// It has this value.
    Known(T),
    /// It depends on block delete: its value with the blocks run and with them skipped, each
    /// `None` where that is not known.
    Either([Option<T>; 2]),
    /// It may have any value.
    Unknown(Source),
}

impl<T: Copy + PartialEq> Know<T> {
    /// The value, if it does not depend on anything.
    #[inline]
    pub fn value(self) -> Option<T> {
        match self {
            Know::Known(value) => Some(value),
            Know::Either([Some(one), Some(other)]) if one == other => Some(one),
            _ => None,
        }
    }

    /// True if nothing in this program has commanded it.
    pub fn is_not_commanded(self) -> bool {
        matches!(self, Know::Unknown(Source::NotCommanded))
    }

    /// True if it may have this value: in one alternative, or since it is unknown.
    pub fn may_be(self, wanted: T) -> bool {
        match self {
            Know::Known(value) => value == wanted,
            Know::Either(values) => values.iter().any(|it| it.is_none_or(|it| it == wanted)),
            Know::Unknown(_) => true,
        }
    }

    /// What holds if either may be in force, `self` with the blocks of block delete run.
    pub fn join(self, skipped: Self) -> Self {
        match (self, skipped) {
            _ if self == skipped => self,
            (Know::Unknown(source), Know::Unknown(_)) => Know::Unknown(source),
            _ => Know::Either([self.value(), skipped.value()]),
        }
    }
}

/// A value of a modal group as a number: groups of all types stand in one table so, and two
/// values of a group are compared as numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Value(u64);

/// A type that a modal group holds.
pub trait Modal: Copy + PartialEq {
    /// As a value of a group.
    fn value(self) -> Value;
    /// Of a value of a group of this type; `None` for a number that means nothing in it.
    fn of(value: Value) -> Option<Self>;
}

macro_rules! modal {
    ($($type:ty: $number:expr, $of:expr;)*) => {
        $(impl Modal for $type {
            #[inline(always)]
            fn value(self) -> Value {
                Value($number(self))
            }
            #[inline(always)]
            fn of(Value(number): Value) -> Option<Self> {
                Some($of(number))
            }
        })*
    };
}

modal! {
    bool: u64::from, |number| number != 0;
    i64: |number| number as u64, |number| number as i64;
    f64: f64::to_bits, f64::from_bits;
    FunctionCode: |code: FunctionCode| code.in_tenths().into(),
        |number| FunctionCode::tenths(number as u32);
    WorkOffset: WorkOffset::as_number, WorkOffset::of_number;
}

macro_rules! choices {
    ($($type:ident: $($choice:ident)*;)*) => {
        $(impl Modal for $type {
            #[inline(always)]
            fn value(self) -> Value {
                // A row that lacks a choice does not compile.
                match self {
                    $($type::$choice => Value(self as u64),)*
                }
            }
            #[inline(always)]
            fn of(value: Value) -> Option<Self> {
                [$($type::$choice),*].into_iter().find(|choice| choice.value() == value)
            }
        })*
    };
}

choices! {
    Plane: Xy Zx Yz;
    Distance: Absolute Incremental;
    Unit: Mm Inch;
    FeedMode: PerMinute PerRevolution InverseTime;
    WorkPlane: Off Rotated Tilted;
    Compensation: Off Left Right;
    CutterPath: Unmoved Moved Leaving;
    Rotation: Unsaid Clockwise Counterclockwise InDoubt Standing;
    Length: Unsaid Called Taken Ended OfAnotherTool;
}

/// What a block that can't be read leaves of a group.
#[derive(Clone, Copy, Debug)]
enum Unread {
    /// Nothing: it may have any value.
    Unknown,
    /// All: such blocks are taken not to change it.
    Kept,
    /// What the function makes of it.
    By(fn(Know<Value>) -> Know<Value>),
}

macro_rules! groups {
    ($($(#[doc = $doc:literal])+ $name:ident / $group:ident: $type:ty = $start:expr, $unread:expr;)*) => {
        /// A modal group of the control.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Group {
            $($(#[doc = $doc])+ $group,)*
        }

        /// All groups, in their order.
        const GROUPS: [Group; COUNT] = [$(Group::$group),*];

        /// Number of groups.
        const COUNT: usize = [$(Group::$group),*].len();

        /// What a block that can't be read leaves of each, in their order.
        const UNREAD: [Unread; COUNT] = [$($unread),*];

        /// What is known of each at the start of a program, in their order.
        fn at_start() -> [Know<Value>; COUNT] {
            [$(begun::<$type>($start)),*]
        }

        $($(#[doc = $doc])+ pub const $name: Of<$type> = Of::new(Group::$group);)*
    };
}

/// A group with the type of its values.
#[derive(Clone, Copy, Debug)]
pub struct Of<T> {
    /// The group.
    pub group: Group,
    values: PhantomData<T>,
}

impl<T> Of<T> {
    const fn new(group: Group) -> Self {
        Of { group, values: PhantomData }
    }
}

/// A group that has a value at the start of a program, or that nothing has commanded.
fn begun<T: Modal>(value: Option<T>) -> Know<Value> {
    value.map_or(Know::Unknown(Source::NotCommanded), |value| Know::Known(value.value()))
}

use Unread::{By, Kept, Unknown};

groups! {
    /// The code of the last motion.
    MOTION / Motion: FunctionCode = None, Unknown;
    /// The plane of arcs, cycles and cutter compensation (G17, G18, G19).
    PLANE / Plane: Plane = None, Unknown;
    /// The plane is one that a single cycle or arc needed.
    PLANE_IS_TEMPORARY / PlaneIsTemporary: bool = Some(false), Kept;
    /// How coordinates count (G90, G91).
    DISTANCE / Distance: Distance = Some(Distance::Absolute), Unknown;
    /// The unit of lengths (G20, G21).
    UNITS / Units: Unit = None, Unknown;
    /// X counts as the post writes it: on a lathe as a diameter, in a transformation as a radius.
    DIAMETER_MODE / DiameterMode: bool = Some(true), Unknown;
    /// What F means (G93, G94, G95).
    FEED_MODE / FeedMode: FeedMode = None, Unknown;
    /// Tool center point control (G43.4, TRAORI, M128).
    TCP / Tcp: bool = Some(false), Unknown;
    /// X, Y and Z count in a tilted work plane, or turned in their plane.
    WORK_PLANE / WorkPlane: WorkPlane = Some(WorkPlane::Off), Unknown;
    /// Cutter compensation (G40, G41, G42).
    CUTTER_COMP / CutterComp: Compensation = Some(Compensation::Off), Unknown;
    /// Whether a motion has begun or ended it.
    CUTTER_PATH / CutterPath: CutterPath = Some(CutterPath::Unmoved), Kept;
    /// A canned cycle is in force: each position drills a hole.
    CYCLE / Cycle: bool = Some(false), Unknown;
    /// The code of the last canned cycle.
    CYCLE_CODE / CycleCode: FunctionCode = None, Unknown;
    /// The code of the level that cycles return to (G98, G99).
    RETURN_LEVEL / ReturnLevel: FunctionCode = None, Unknown;
    /// The tool in the spindle.
    TOOL / Tool: i64 = None, By(either_stays);
    /// The tool that an author's T word named since the last tool change of the post.
    NAMED_TOOL / NamedTool: i64 = None, Unknown;
    /// The offset that was called with it.
    TOOL_OFFSET / ToolOffset: i64 = None, Unknown;
    /// A function changed the tool (M6).
    TOOL_CHANGED / ToolChanged: bool = None, Kept;
    /// A T word of an author changed the tool by itself, as on a turret.
    TOOL_WORD / ToolWord: bool = None, Kept;
    /// Tool length offset, as far as functions have activated or canceled it (G43, G49).
    LENGTH / Length: Length = Some(Length::Unsaid), Kept;
    /// The offset number of the tool length offset (H).
    LENGTH_OFFSET / LengthOffset: i64 = None, Unknown;
    /// An author named a tool length offset, or canceled it.
    LENGTH_WORD / LengthWord: bool = None, Kept;
    /// The work offset (G54).
    WORK_OFFSET / WorkOffset: WorkOffset = None, Unknown;
    /// The work offset that the CL file asked for.
    ASKED_OFFSET / AskedOffset: WorkOffset = None, Kept;
    /// How the spindle was last told to turn.
    SPINDLE / Spindle: Rotation = Some(Rotation::Unsaid), By(rotation_unread);
    /// M0 or M1 came since the spindle was turned: some machines stop it.
    SPINDLE_HALTED / SpindleHalted: bool = Some(false), Kept;
    /// The sub-spindle of a lathe is the master spindle.
    MASTER_IS_SUB / MasterIsSub: bool = None, Unknown;
    /// S is a surface speed (G96, G97).
    SURFACE_SPEED / SurfaceSpeed: bool = None, By(surface_speed_unread);
    /// The highest speed of the spindle, rev/min.
    SPEED_LIMIT / SpeedLimit: f64 = None, Kept;
    /// The code of the gear.
    GEAR / Gear: FunctionCode = None, Unknown;
    /// The rotary axes are clamped.
    AXIS_CLAMP / AxisClamp: bool = Some(false), Kept;
    /// The program has ended (M2, M30).
    PROGRAM_END / ProgramEnd: bool = Some(false), Kept;
}

/// A tool that depends on block delete is one until a tool change.
fn either_stays(before: Know<Value>) -> Know<Value> {
    match before {
        Know::Either(_) => before,
        _ => Know::Unknown(Source::Author),
    }
}

/// Texts of a shop are taken not to turn a spindle that runs clockwise.
fn rotation_unread(before: Know<Value>) -> Know<Value> {
    match before {
        Know::Known(value) => begun(Rotation::of(value).map(Rotation::doubted)),
        other => other,
    }
}

/// S may still be a surface speed if it was one.
fn surface_speed_unread(before: Know<Value>) -> Know<Value> {
    match before {
        Know::Known(value) if value == true.value() => Know::Either([Some(value), None]),
        Know::Known(_) => Know::Unknown(Source::Author),
        other => other,
    }
}

/// One group: what is known, and the count of changes when it was last written.
#[derive(Clone, Copy, Debug)]
struct Cell {
    know: Know<Value>,
    written: u32,
}

/// What is known of all modal groups.
#[derive(Clone, Debug)]
pub struct Groups {
    cells: [Cell; COUNT],
    /// Those that are known to be as motions need them.
    usual: GroupSet,
    /// Counts the writes, so that two groups can be told apart by which was written last.
    writes: u32,
    /// That count when the last block of an author began.
    before_foreign: u32,
}

impl Groups {
    /// As a program starts.
    pub fn at_start() -> Self {
        let cells = at_start().map(|know| Cell { know, written: 0 });
        let usual = GroupSet::default();
        let mut groups = Groups { cells, usual, writes: 0, before_foreign: 0 };
        GROUPS.into_iter().zip(at_start()).for_each(|(group, know)| groups.know_now(group, know));
        groups
    }

    /// What is known of a group from here on; it counts as no write.
    #[inline]
    fn know_now(&mut self, group: Group, know: Know<Value>) {
        self.cells[group as usize].know = know;
        let usual = matches!(know, Know::Known(value) if is_usual(group, value));
        self.usual.put(group as usize, usual);
    }

    /// True if all of these are known to be as motions need them. One test for all: it comes
    /// several times with each motion. If not, each is to be looked at.
    #[inline]
    pub fn are_usual(&self, groups: GroupSet) -> bool {
        self.usual.has_all(groups)
    }

    /// The value of a group, if it is known.
    #[inline(always)]
    pub fn get<T: Modal>(&self, of: Of<T>) -> Option<T> {
        match self.cells[of.group as usize].know {
            Know::Known(value) => T::of(value),
            know => know.value().and_then(T::of),
        }
    }

    /// True if a group certainly has a value.
    #[inline]
    pub fn is<T: Modal>(&self, of: Of<T>, value: T) -> bool {
        match self.cells[of.group as usize].know {
            Know::Known(known) => known == value.value(),
            know => know.value() == Some(value.value()),
        }
    }

    /// True if a group may have a value.
    #[inline]
    pub fn may_be<T: Modal>(&self, of: Of<T>, value: T) -> bool {
        self.cells[of.group as usize].know.may_be(value.value())
    }

    /// The value of any group, if it is known.
    pub fn value(&self, group: Group) -> Option<Value> {
        self.cells[group as usize].know.value()
    }

    /// What is known of a group.
    pub fn know<T: Modal>(&self, of: Of<T>) -> Know<T> {
        let typed = |value: Option<Value>| value.and_then(T::of);
        match self.cells[of.group as usize].know {
            Know::Known(value) => T::of(value).map_or(Know::Unknown(Source::Post), Know::Known),
            Know::Either(values) => Know::Either(values.map(typed)),
            Know::Unknown(source) => Know::Unknown(source),
        }
    }

    /// True if a group depends on block delete.
    pub fn depends_on_block_delete<T>(&self, of: Of<T>) -> bool {
        matches!(self.cells[of.group as usize].know, Know::Either(_))
    }

    /// A block gives a group a value.
    #[inline]
    pub fn set<T: Modal>(&mut self, of: Of<T>, value: T) {
        self.write(of.group, Know::Known(value.value()));
    }

    /// The same, or it becomes unknown.
    pub fn set_if_known<T: Modal>(&mut self, of: Of<T>, value: Option<T>, source: Source) {
        match value {
            Some(value) => self.set(of, value),
            None => self.forget(of, source),
        }
    }

    /// A group may have any value.
    pub fn forget<T>(&mut self, of: Of<T>, source: Source) {
        self.write(of.group, Know::Unknown(source));
    }

    /// A block that can't be read may have changed a group.
    pub fn doubt<T>(&mut self, of: Of<T>) {
        let before = self.cells[of.group as usize].know;
        self.know_now(of.group, unread(of.group, before, Source::Author));
    }

    /// What is known of a group from here on.
    #[inline]
    pub fn write(&mut self, group: Group, know: Know<Value>) {
        self.writes += 1;
        self.cells[group as usize].written = self.writes;
        self.know_now(group, know);
    }

    /// A block that can't be read may have changed all groups.
    pub fn doubt_all(&mut self, source: Source) {
        for group in GROUPS {
            self.know_now(group, unread(group, self.cells[group as usize].know, source));
        }
    }

    /// A block of an author begins.
    pub fn foreign_begins(&mut self) {
        self.before_foreign = self.writes;
    }

    /// True if a group was written since the last block of an author began.
    pub fn changed_since_foreign<T>(&self, of: Of<T>) -> bool {
        self.cells[of.group as usize].written > self.before_foreign
    }

    /// When a group was last written, as a count of writes.
    pub fn written<T>(&self, of: Of<T>) -> u32 {
        self.cells[of.group as usize].written
    }

    /// What holds if either may be in force, `self` with the blocks of block delete run.
    pub fn join(&mut self, skipped: &Groups) {
        let tool = [self, skipped].map(|it| it.get(TOOL));
        let offsets =
            |it: &Groups| (it.get(TOOL_OFFSET), it.get(LENGTH_OFFSET), it.written(LENGTH_WORD));
        let tool_differs = tool[0] != tool[1] || offsets(self) != offsets(skipped);
        for group in GROUPS {
            let [own, other] = [&*self, skipped].map(|it| it.cells[group as usize].know);
            let know = match (group, own, other) {
                (Group::Spindle, Know::Known(one), Know::Known(other)) => begun(
                    Rotation::of(one).zip(Rotation::of(other)).map(|(one, other)| one.or(other)),
                ),
                (Group::Length, Know::Known(one), Know::Known(other)) => {
                    begun(Length::of(one).zip(Length::of(other)).map(|(one, other)| one.or(other)))
                }
                (_, one, other) => one.join(other),
            };
            self.know_now(group, know);
        }
        if tool_differs {
            // A tool with another offset is another one.
            self.know_now(Group::Tool, Know::Either(tool.map(|tool| tool.map(Modal::value))));
        }
    }
}

fn unread(group: Group, know: Know<Value>, source: Source) -> Know<Value> {
    match UNREAD[group as usize] {
        Unknown => Know::Unknown(source),
        Kept => know,
        By(rule) => rule(know),
    }
}

#[cfg(test)]
mod tests;
