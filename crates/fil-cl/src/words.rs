//! The words a post names in its code, as constants.
//!
//! One list makes both the constants and the table [`Vocabulary::new`]
//! interns first, so an id and its name cannot drift apart.
//!
//! [`Vocabulary::new`]: crate::vocabulary::Vocabulary::new

use crate::vocabulary::{MAJOR, MINOR, WordId};

macro_rules! words {
    ($($class:ident { $($id:ident $(= $name:literal)?,)* })*) => {
        #[allow(non_camel_case_types, clippy::upper_case_acronyms)]
        enum Position { $($($id,)*)* }

        $($(
            #[doc = concat!("The word ", words!(@name $id $($name)?), ".")]
            pub const $id: WordId = WordId(Position::$id as u32);
        )*)*

        /// Name and class of every constant, in the order of the ids.
        pub(crate) const NAMES_AND_CLASSES: &[(&str, u8)] = &[$($((words!(@name $id $($name)?), $class),)*)*];
    };
    (@name $id:ident) => { stringify!($id) };
    (@name $id:ident $name:literal) => { $name };
}

/// The name of a word of this list; empty for another.
pub(crate) fn name(word: WordId) -> &'static str {
    NAMES_AND_CLASSES.get(word.index()).map_or("", |(name, _)| name)
}

/// True for the name of a word of this list that opens statements, in any case.
pub(crate) fn is_major_name(name: &[u8]) -> bool {
    NAMES_AND_CLASSES
        .iter()
        .any(|(known, class)| class & MAJOR != 0 && known.as_bytes().eq_ignore_ascii_case(name))
}

/// A word used both as the major word of a statement and inside one.
const EITHER: u8 = MAJOR | MINOR;

words! {
    MAJOR {
        GOTO, FROM, GODLTA, CIRCLE, CUTTER, TLAXIS, MULTAX, FINI,
        RAPID, FEDRAT, SPINDL, COOLNT, LOADTL, LOAD, UNLOAD, SELCTL, SELECT, TURRET, TOOLNO,
        CYCLE, CUTCOM, DELAY, STOP, OPSTOP, ISTOP, END, REWIND, BREAK, RETRCT, RESET, SWITCH,
        PPRINT, INSERT, PARTNO, LETTER, REMARK, TITLES, TPRINT, TOOL_PATH = "TOOL PATH",
        MACHIN, UNITS, UNIT, PREFUN, AUXFUN, SEQNO, MODE, OP, TRANS, TRACUT, REPEAT, REPLAC,
        POSTN, ROTATE, ROTABL, ROTHED, HEAD, OPSKIP, PLABEL, SET, LINTOL, ARCSLP, GOHOME,
        CALSUB, DEFSUB, ENDSUB, PPWORD, CAMERA, FEATNO, CSYS, MFGNO, CUTCOM_GEOMETRY_TYPE,
        PLUNGE, CLEARP, TMARK, REVERS, AIR, LEADER, PPLOT, MCHTOL, PIVOTZ, MCHFIN, INTCOD,
        DISPLY, CHECK, ORIGIN, SAFETY, DEBUGG, COUPLE, PITCH, MDWRIT, MDEND, ASLOPE,
        CLRSRF, DRAFT, CLAMP, MAXDPM, SLOWDN, CHUCK, INDEX, COPY, DMIS, FLUSH, GENRTR, SYNC,
        SETTOOL, REDEF, PRINT, TLDATA, MSYS, PAINT, END_OF_PATH = "END-OF-PATH",
        TRNTYP, INDIRV, INDIRP, TLON, TLLFT, TLRGT, GO, GOFWD, GOBACK, GOLFT, GORGT, GOUP,
        GODOWN, PSIS, NURBS, KNOT, CNTRL, CUT, DNTCUT, TOLER, INTOL, OUTTOL, AUTOPS,
    }
    EITHER {
        THREAD, DWELL, TOOL, TURN, MILL,
    }
    MINOR {
        ON, OFF, IN, OUT, ALL, NONE, NOW, NEXT, LAST, SAME, START, NOMORE, AUTO, MANUAL,
        MM, CM, INCHES, IPM, IPR, MMPM, MMPR, FPM, FPR, UPM, UPR, INVERS, MAXIPM,
        RPM, SFM, SMM, CLW, CCLW, CLOCKWISE, COUNTERCLOCKWISE, MAXRPM, RANGE, ORIENT, CSS,
        FLOOD, MIST, TAP, THRU, LOW, MEDIUM, HIGH, CONST,
        LEFT, RIGHT, XYPLAN, YZPLAN, ZXPLAN, XZPLAN, PERPTO,
        XAXIS, YAXIS, ZAXIS, AAXIS, BAXIS, CAXIS, XCOORD, YCOORD, ZCOORD,
        NEGX, NEGY, NEGZ, POSX, POSY, POSZ,
        DRILL, DEEP, DEEP2, BRKCHP, FACE, CSINK, CBORE, BORE, REAM, INIT,
        DEPTH, STEP, CLEAR, RAPTO, RTRCTO, RETURN, PULBAC, FEDTO, FEED, REV, BACK, TIMES,
        FIRST_PECK = "1STPECK", SUBPECK, OMIT, TRAV, MODIFY, OFFSET, DIAMTR, RADIUS,
        LENGTH, OSETNO, DIAMET, TLANGL, OFSETL, ADJUST, OPTION, INCR, DECR, ABSOL, HOLDER, GRIPER,
        TPI, TYPE, AT, TO, PAST, MULTRD, CUTS, FINCUT, CUTANG, TAPER, CAM,
        TABLE, ROTREF, OTHER, CENTER, BOTH, MAIN, SIDE, FRONT, REAR, SADDLE,
        LARGE, SMALL, SCALE, SLOPE, MIRROR, LINEAR, CIRCUL, LINCIR, PARAB, NORMAL, UP, DOWN,
        LOCK, HED, WORLD, PLUS, MINUS, ATANGL, MACRO, LINE, COLOR, SPEED,
    }
}
