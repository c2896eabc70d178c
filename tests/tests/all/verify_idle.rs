//! Faults in axis words of the suites that nobody has to see: the tool comes to the same place.

/// Programs with axis words whose last digit a rounding may leave open: points between the
/// ends of lines that another post has divided, points of arcs that are lines, values half
/// way between two; poles of helices and arcs of Klartext.
pub const ROUNDED: [&str; 18] = [
    "corpus/klartext/helices",
    "words/circle-full-behind-a-helix-in-klartext",
    // A way around a cylinder, and a direction that CL files round.
    "corpus/lathe/sinumerik-mill-turn/cylinder-groove",
    "corpus/lathe/sinumerik-mill-turn/grooves-on-two-cylinders",
    // Infeeds half way between two diameters.
    "corpus/lathe/sinumerik-mill-turn/thread-and-flats",
    "five-axes/two-tables-axes",
    "heidenhain-tnc640/inches",
    "verify/linearized-",
    "verify/inverse-time-",
    "words/circle-below-the-least-radius-becomes-lines",
    // Under tip control the tool stands upright, whatever C does.
    "words/cycle-bore-single-moves-as-its-cycle",
    "words/goto-a-little-farther-writes-nothing",
    "words/goto-in-steps-of-a-resolution",
    "words/goto-on-a-tilted-table-rounds-halves-alike",
    "words/rotary-",
    "holes/two-tables-tip",
    "holes/two-tables-posted-tip",
    "corpus/posts/",
];

/// Words of an axis, by the program, the letter and the block, that bring no tool to the part
/// elsewhere, whatever they say.
pub const IDLE: [(&str, u8, &str); 48] = [
    // Higher than RETURN: the control returns to where the cycle begins, clear of the part.
    ("words/cycle-behind-another-cycle-returns-to-its-own-level", b'Z', "`Z1.`"),
    // The rapid that begins TCPC goes straight up to the same Z.
    ("words/rotary-tcpc-after-an-arc-in-another-plane", b'Z', "`G0 Z50.`"),
    // Where a long line is divided: the tool goes through the point, and no block is too long.
    ("words/goto-longer-than-a-block-may-be", b'X', "`G1 X35. F100.`"),
    // The rapid back after a repositioning ends farther away: more of the way is made at feed.
    ("words/rotary-limit-at-rapid-retracts-and-returns", b'Z', "`Z-2.665`"),
    // The machine turns higher, and the way back at feed is longer.
    ("words/rotary-travel-of-z-takes-other-positions", b'Z', "`G0 Z140.`"),
    // The rapid to where polar interpolation begins: what is left of the way is made in it.
    ("corpus/lathe/fanuc-mill-turn/", b'X', "G0 X26. C0.`"),
    ("corpus/lathe/fanuc-mill-turn/", b'X', "G0 X30. C0.`"),
    ("corpus/lathe/fanuc-mill-turn/", b'X', "G0 X43.863 C0.`"),
    ("corpus/lathe/sinumerik-mill-turn/", b'X', "G0 X26 C0`"),
    ("corpus/lathe/sinumerik-mill-turn/", b'X', "G0 X30 C0`"),
    ("corpus/lathe/sinumerik-mill-turn/", b'X', "G0 X3.1623 C0`"),
    ("corpus/lathe/sinumerik-mill-turn/", b'X', "G0 X43.863 C0`"),
    ("corpus/lathe/sinumerik-mill-turn/", b'X', "G0 X83.522 C0`"),
    // The tip stands there already: C where TRACYL has brought it, an arc that ends at its Y.
    ("corpus/lathe/sinumerik-mill-turn/cylinder-groove", b'C', "G0 X60 C90`"),
    ("corpus/lathe/sinumerik-mill-turn/grooves-on-two-cylinders", b'C', "G0 X60 C9`"),
    ("corpus/klartext/helices", b'Y', "C X-13.333 Y+3.333 DR+`"),
    // The pole of the helix before is as near as its last digits say.
    ("corpus/klartext/helices", b'Y', "CC X-13.3333 Y-0.0002`"),
    ("words/circle-full-behind-a-helix-in-klartext", b'X', "CC X+29.9266 Y-25.3024`"),
    ("words/circle-full-behind-a-helix-in-klartext", b'Y', "CC X+29.9266 Y-25.3024`"),
    ("heidenhain-tnc640/inches", b'X', "CC X+0.75004 Y+0.50002`"),
    ("heidenhain-tnc640/inches", b'Y', "CC X+0.75004 Y+0.50002`"),
    // A rapid beside the part, from which the cycle goes to its own place.
    ("heidenhain-tnc640/holes", b'X', "L X+0 Y+20 FMAX`"),
    ("heidenhain-tnc640/holes", b'Y', "L X+0 Y+20 FMAX`"),
    ("words/cycle-return-behind-another-zero-goes-across-first", b'X', "`X20. Y0.`"),
    ("words/cycle-return-behind-another-zero-goes-across-first", b'Y', "`X20. Y0.`"),
    ("words/thread-by-cycle97", b'X', "`G0 X28 Z"),
    ("words/thread-by-cycle97", b'Z', "`G0 X28 Z"),
    // Without the level above the holes the tool travels higher.
    ("words/cycle-rapto-from-clear", b'Z', "`Z3.`"),
    ("words/cycle-return-below-the-level-before-goes-down", b'Z', "`Z5.`"),
    // The height to which the tool goes up, and from which it comes back at feed.
    ("words/cycle-bore-single-moves-as-its-cycle", b'Z', "`Z302.`"),
    ("words/rotary-limit-retracts-", b'Z', "Z4.508`"),
    ("words/rotary-limit-retracts-", b'Z', "Z49.508 C-170.`"),
    ("words/rotary-tilted-frame-and-another-offset", b'Z', "`G0 Z200.`"),
    ("words/retrct-in-a-tilted-frame-goes-to-the-level-of-the-machine", b'Z', "L Z+272.667 FMAX"),
    // Before tool-tip control ends the tool goes up as far as the machine asks, or farther.
    ("words/rotary-tip-control-and-an-offset-at-the-end", b'Z', "`Z350.`"),
    ("words/rotary-tip-control-begins-behind-a-length", b'Z', "Z305.`"),
    ("words/rotary-tip-control-begins-behind-a-length", b'Z', "`Z450.`"),
    ("words/tip-control-out-of-the-frame-of-a-leaning-head", b'Z', "`G0 Z270.`"),
    // Behind the frame the level is said again.
    (
        "words/tool-change-position-out-of-the-frame-of-a-leaning-head",
        b'Z',
        "`L Z+100 FMAX` without",
    ),
    // The tool stands upright under tip control, whatever C does.
    ("words/rotary-tip-control-begins-behind-a-length", b'C', "A0. C0.`"),
    // Angles before the direction of the tool is said, and the other name of half a turn.
    ("words/rotary-direction-", b'A', "A25. C0.`"),
    ("words/rotary-direction-", b'A', "A30. C0.`"),
    ("words/rotary-direction-", b'C', " C0.`"),
    ("words/rotary-tilted-frame-and-multax", b'C', " C-180.`"),
    // G53.1 turns the head to the angle of its frame.
    ("words/tip-control-out-of-the-frame-of-a-leaning-head", b'B', "G0 B36.87 C0.`"),
    // The tool lies along C, and the next motion says the angle that it needs.
    ("words/rotary-tilted-frame", b'C', "A0. C0.`"),
    // The steps of the machine are larger than a last digit.
    ("words/goto-in-steps-of-a-resolution", b'X', "X1.05 Y-2.05`"),
    ("words/goto-in-steps-of-a-resolution", b'Y', "X1.05 Y-2.05`"),
];
