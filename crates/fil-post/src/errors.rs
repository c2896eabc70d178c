//! Codes of the post (05xx) and of machine settings (06xx).

fil_diag::codes! {
    /// Everything the post refuses or warns about.
    pub enum PostCode {
        /// Motion without position.
        ArcStart = 503, Error, "arc without a start point",
            "An arc starts where the previous move ended. No move came before it, or the tool is no longer there: after a cycle, a foreign block, TRANS, or a FROM between moves.",
            "Put a GOTO to the start point before the CIRCLE, after everything else that moves the axes.";
        /// Radii disagree.
        ArcRadius = 504, Error, "arc radii at start and end disagree",
            "Start and end of an arc must be at the same distance from its center.",
            "Check center, start and end of the CIRCLE and the GOTO after it.";
        /// CIRCLE without GOTO.
        ArcEnd = 505, Error, "CIRCLE without an end point",
            "A CIRCLE takes its end point from the GOTO right after it.",
            "Put the GOTO of the end point after the CIRCLE.";
        /// A word form.
        WordForm = 506, Error, "post word in an unknown form",
            "filpost does not guess what an unknown form means: the block would be a guess too.",
            "`filpost explain WORD` shows the forms of a post word.";
        /// What the language of the control can't say.
        Family = 560, Error, "the control has no code for this",
            "Klartext and SINUMERIK have fixed functions: no other G codes, no such cycle, or no block delete. filpost does not leave out what the control can't do.",
            "Take the record with a FIL section, and write the blocks with INSERT.";
        /// A missing code.
        NoCode = 507, Error, "the machine has no code for this",
            "The setting with the G or M code is empty.",
            "Set the code in machine.toml, or take the record with a FIL section.";
        /// Feed motion without feed.
        NoFeed = 509, Error, "feed move without a feed",
            "A feed move needs a feed, and none was given before it.",
            "Put a FEDRAT before the first GOTO that is not rapid.";
        /// Sequence of cycle.
        CycleForm = 511, Error, "canned cycle with missing or invalid values",
            "The control or the post can't drill the hole without this value.",
            "Give DEPTH, a feed and CLEAR (and STEP for DEEP and BRKCHP).";
        /// No unit.
        NoUnit = 514, Error, "no unit given: mm or inch",
            "Lengths and feeds have no meaning until the CL file, the machine or the user sets mm or inch.",
            "Put UNITS / MM or UNITS / INCHES first, give --units mm or --units inch, or set units.mode (1 inch, 2 mm).";
        /// UNITS in mid-file.
        UnitChange = 515, Error, "unit changes within the CL file",
            "Positions, feeds and limits given before would be read in the other unit, so one of the two statements is wrong.",
            "Keep one unit in a CL file.";
        /// Units that contradict each other.
        Units = 715, Error, "units contradict each other",
            "--units, the CL file and the machine must have the same unit.",
            "Leave out --units if the CL file has UNITS, or correct units.mode of the machine.";
        /// Blocks after the end.
        AfterEnd = 516, Error, "block after the end of the program",
            "The control stops at M2 or M30 and never reads what comes after it.",
            "Move END, REWIND or the block that ends the program (M30, M99) behind the last record that writes a block.";
        /// A character that must not reach the tape.
        TextCharacter = 517, Error, "character not allowed in the program",
            "A percent sign ends the program at the control, and control characters have unpredictable effects.",
            "Remove the character from the text.";
        /// A program number.
        ProgramNumber = 518, Error, "program number out of range",
            "A program number has four digits on most controls, five or eight on some, and never more.",
            "Set program.number to another number.";
        /// Compensation left on.
        CompensationOn = 519, Error, "cutter compensation is still on",
            "The control would keep compensating with the wrong tool, or alarm.",
            "Put CUTCOM / OFF before it.";
        /// Compensation on an arc.
        CompensationOnArc = 520, Error, "cutter compensation starts or ends on an arc",
            "Controls apply and cancel the offset only on a straight move.",
            "Put a straight move between CUTCOM and the CIRCLE.";
        /// Compensation of a path in a mirror.
        CompensationSide = 530, Error, "mirroring swaps the side of cutter compensation",
            "When the path is mirrored, or seen from below, left and right change places: the tool would cut on the wrong side.",
            "Mirror the path and its compensation in the CAM system, or take CUTCOM with a FIL section that writes the side of the mirrored path.";
        /// Compensation that is lost.
        CompensationLost = 521, Doubt, "cutter compensation state is uncertain",
            "A foreign block may have switched compensation, and restating the code would start it again.",
            "Put the text before CUTCOM or after CUTCOM / OFF.";
        /// Something in a cycle.
        InCycle = 522, Error, "not allowed in an active cycle",
            "The cycle is still active: the next GOTO would drill a hole.",
            "Put CYCLE / OFF before it.";
        /// Sense of an arc.
        ArcSense = 523, Error, "arc seems to run in the wrong direction",
            "CAM systems disagree about the axis of a CIRCLE. Read in the wrong dialect, every arc runs the other way.",
            "Choose the dialect of the CL file with --dialect. If the arc is right as it is, write it as lines.";
        /// A tool that lies across Z.
        Leaning = 538, Error, "Z retract with the tool lying across Z",
            "Z alone would drag the tool sideways through the part.",
            "Retract the tool with RAPID and GOTO, and turn it upright there.";
        /// A second tool, or zero, with which the machine turns.
        TurnedApart = 539, Error, "rotary axes were positioned for another tool or work offset",
            "Axis positions include the distance from the pivot of a head to the tool tip, and from the origin of the work offset to the axis of a table. The machine has one setting for each.",
            "Post with TCPC or tilted work planes, where the control knows both, or make one program for each. For a retract in machine Z, turn the tool upright first, or set home.frame = 1.";
        /// A rotary axis the long way round.
        Unwinding = 524, Error, "rotary axis would unwind while cutting",
            "Within the axis limits there is only another rotary solution for this tool axis, and the tool would cut while the axes turn to it.",
            "Let the tool retract: set repos.retract_distance with repos.feed_method = 1, or write a macro _REPOS. Or retract in the CL file, or give the axis more travel.";
        /// A limit that nothing leads past.
        NoAlternative = 527, Error, "rotary axis at its limit has no other solution",
            "The tool would retract, the rotary axes would turn to another solution for the same tool axis, and the tool would return. Here no other solution lets the path continue, or the retract is not known.",
            "Set repos.retract_distance, give the axis more travel, or split the path in the CAM system and retract between its parts.";
        /// A pole at feed.
        Pole = 528, Error, "feed move passes a pole of the rotary axes",
            "Near the direction of a rotary axis, a small change of the tool axis needs a large rotary move, and the tool tilts out of the plane of its end positions.",
            "Add points there in the CAM system, or keep the tool axis away from the pole. rotary.axis_tolerance is the allowed deviation; 0 switches the check off.";
        /// A retract at a limit.
        Repositioned = 529, Warning, "tool retracts at the limit of a rotary axis",
            "The rotary axes turn to another solution for the same tool axis, and the tool returns to the same point.",
            "Check that the retract is far enough for the part to turn. repos.feed_warning = 0 silences this warning.";
        /// A motion outside of the travel that the machine allows.
        BeyondTravel = 586, Warning, "X, Y or Z exceeds its travel",
            "repos.check_linear lets the axis go there with a warning (repos.x_exceeded to repos.z_exceeded = 2); without it the move would be refused.",
            "Check that the machine gets there, move the part, or set 1 instead of 2 to use another rotary solution there.";
        /// A rapid motion to other positions than the nearest.
        RapidRepositioned = 587, Warning, "rapid move uses another rotary solution",
            "The nearest solution for the tool axis is past a limit, or the moves after the RAPID would run into one from there.",
            "Check that the tool is clear of the part while the axes turn. repos.rapid_retract = 1 retracts it first; repos.rapid_warning = 0 silences this warning.";
        /// What a look-ahead has tried.
        LookAhead = 595, Warning, "rotary solutions compared before a rapid move",
            "repos.optimise_trace lists for each RAPID the rotary solutions that were tried, how many limits and poles the moves after it meet from each, and which one is used.",
            "Set repos.optimise_trace = 0 to switch this list off; nothing is wrong.";
        /// Length of a tool axis.
        AxisLength = 525, Error, "invalid tool axis",
            "A tool axis has length 1; six values of another length may be two points. After MULTAX / OFF only the tool axis 0,0,1 is allowed.",
            "Check the GOTO; MULTAX / ON allows axes of any length except zero.";
        /// A part on both sides of a skip mark.
        SkippedPart = 526, Error, "command is split by a block-delete section",
            "With block delete on, the control would run only half of the command.",
            "Put the whole command on one side of OPSKIP.";
        /// A motion that is safe at one position of the skip switch only.
        SkippedLevel = 531, Error, "no move is safe with block delete on and off",
            "The position of the tool after OPSKIP / OFF depends on the block delete switch. The order of the axes, and the initial plane of a cycle, would be right for one of the two positions only.",
            "After OPSKIP / OFF, put a RAPID to a height above both positions; before OPSKIP / ON, one to a known height.";
        /// A rapid motion from a height that is not known.
        UnknownLevel = 532, Doubt, "rapid move from an unknown height",
            "A foreign block, a subprogram call or a new work offset came before it, so the tool may be above or below the end point. Z first could plunge, XY first could go through the part.",
            "Before it, put GOHOME, RETRCT, LOADTL, a block to the machine's reference point (G91 G28 Z0.), or RAPID with a GOTO straight up. Before a new work offset, retract with RAPID.";
        /// A rapid motion at a height that counts from another zero, or that a script has cleared.
        ShiftedLevel = 533, Warning, "rapid XY move at a Z height in doubt",
            "The work offset or the tool length offset has changed since the tool went to its height, or a script cleared the last Z after a block that may have moved it. How far it is above the part is not known.",
            "Check that the tool is clear in both offsets, or put GOHOME, RETRCT or LOADTL before the change.";
        /// A feed a turn of a spindle that stands.
        FeedStands = 534, Error, "feed per revolution with the spindle stopped",
            "The control counts the feed in spindle revolutions, and waits for them while the spindle is stopped.",
            "Put SPINDL / RPM with a direction before it, or give a feed per minute.";
        /// A motion at feed of a rotary axis that may stand anywhere.
        UnknownTurn = 535, Doubt, "feed move from an unknown rotary position",
            "A foreign block or a subprogram call came before it and may have turned the axis. The move would turn it back at feed by any angle, and the tip would leave its line.",
            "Put RAPID and a GOTO before it, which position the axis, or a block with its position (G0 A0.).";
        /// A motion without the length of the tool.
        LengthTaken = 536, Doubt, "tool length offset is not active",
            "A foreign block cancelled the tool length offset, or changed the tool without activating its offset. Z of the CL file is the tool tip: the control would move the spindle nose there, or use the length of another tool.",
            "Activate the offset in this block or a later one (G43 H1, on a SINUMERIK D1), or put LOADTL before the move.";
        /// Another work offset than that of the CL file.
        OtherOffset = 550, Warning, "foreign block replaces the work offset of the CL file",
            "SET/OFSETL selected a work offset, and an INSERT, a POSTN or a machine block has another one: the moves after it are cut in that offset.",
            "Remove the work offset from the text, or put SET/OFSETL after it.";
        /// A program number within a program.
        SecondProgram = 551, Warning, "second program number",
            "The post wrote a program number, and a foreign block starts another program before the end of this one. The control would store two programs, the first without an end.",
            "Set the number by PARTNO or program.number and remove it from the text, or set program.number_address = \"none\". Put a subprogram after the end of the program.";
        /// A rotary axis that is clamped.
        TurnsClamped = 537, Error, "clamped rotary axis would turn",
            "CLAMP/ON or a foreign block clamped the rotary axes, and nothing has released them since: the drive would turn against the brake, or the control would alarm.",
            "Put CLAMP / OFF before the rotary move.";
        /// A rapid along a leaning tool that is not straight.
        RapidBends = 540, Error, "dog-leg rapid with a tilted tool",
            "With a tilted head, a rapid along the tool moves two or three axes. This control moves each of them at its own speed (rapid.straight = 2), so the tool would leave its line and hit the part.",
            "Output these moves at feed in the CAM system, or switch the control to straight rapids and set rapid.straight = 1.";
        /// A block that is too long.
        BlockLength = 541, Error, "block is longer than the control reads",
            "The control would lose the end of a block that is longer than its buffer.",
            "Shorten the text, remove blanks with tape.blank, or correct tape.max_block of the machine.";
        /// A letter that the encoding of the tape lacks.
        TapeLetter = 543, Error, "character not available in the program's encoding",
            "The program is written in a code page of the control (tape.encoding), which lacks this character. A substitute would change the text.",
            "Use characters of that code page, set tape.encoding to the control's code page, or write all texts in ASCII with tape.characters = 1.";
        /// Blocks without a motion under compensation.
        StillBlocks = 572, Warning, "too many non-motion blocks during cutter compensation",
            "Several blocks without a move in the compensation plane (M functions, a dwell, a stop, a depth) come between two moves under G41 or G42. A control that reads few blocks ahead does not see the second move, and cuts too much or too little at the corner.",
            "Put these blocks before CUTCOM or after CUTCOM/OFF. Ignore this if the control reads as many blocks ahead, or the path goes straight on.";
        /// A feed a turn, of one of two spindles.
        FeedOfSpindle = 573, Warning, "feed per revolution while another spindle is the master",
            "The sub-spindle runs by spindle.side_cw_code, and no setting selects the master spindle: the feed may follow the main spindle, which is stopped or turns at another speed.",
            "Set spindle.side_master_code and spindle.main_master_code (on a SINUMERIK spindle.side_number), or give feeds per minute. Ignore this if the codes of the sub-spindle make it the master.";
        /// A motion of too many parts.
        TooManyParts = 580, Error, "linearization needs too many segments",
            "Keeping the tool tip on its line in a rotary move, or its feed constant, takes too many blocks. An arc of many turns that is written as lines can need too many, too.",
            "Increase LINTOL, rotary.tolerance or circle.chord_tolerance, reduce TIMES, or increase the feed. Check that the part is near the rotary axes.";
        /// A feed a revolution while the machine turns.
        RotaryFeedUnknown = 581, Error, "feed of a rotary move is unknown",
            "The time of a rotary move is the path of the tip divided by its feed per minute.",
            "Put SPINDL before it, or give the feed in MMPM or IPM.";
        /// A thread and a turn.
        ThreadTurns = 582, Error, "rotary move within a thread",
            "A threading block moves X, Y and Z only.",
            "Change the tool axis before or after the thread.";
        /// Surface speed without a limit.
        SpeedLimit = 583, Error, "constant surface speed without a speed limit",
            "At constant surface speed the spindle turns faster the nearer the tool comes to its axis, so a highest speed must be set first.",
            "Give SPINDL / MAXRPM, or set spindle.css_limit. If the control limits the speed itself, set spindle.css_unlimited = 1.";
        /// A speed above MAXRPM.
        AboveSpeedLimit = 592, Warning, "spindle speed above the active limit",
            "The limit of MAXRPM stays active until a new one is given. Many controls hold every spindle speed to it, so the spindle may turn slower than programmed.",
            "Give this SPINDL its own MAXRPM, at or above the speed.";
        /// No such station.
        Station = 584, Error, "turret has no such station",
            "The tool number is above the last station: the turret would turn to another one, or alarm.",
            "Correct the tool number, or turret.stations of the machine.";
        /// A thread that can't be cut.
        Thread = 585, Error, "thread can't be cut",
            "A value of the thread is missing or invalid, or the machine is in a mode without threading.",
            "Give a lead, a depth and passes above zero, two points of the crest, and a spindle speed (SPINDL / RPM), without cutter compensation.";
        /// Something under tool-tip control.
        TipControl = 588, Error, "not allowed under TCPC",
            "TCPC needs the tool length, and can end only where the tables may turn back to zero.",
            "Put LOADTL before it, or output axis positions with rotary.tip_output = 0.";
        /// Something in a tilted frame.
        Frame = 589, Error, "not allowed in a tilted work plane",
            "A tilted work plane does not move, and the machine turns to it only while the tool is away from the part.",
            "Put LOADTL, GOHOME or RETRCT before the new tool axis, set home.retract_z, or output axis positions with rotary.frame_output = 0.";
        /// Compensation in a plane that the tool is not square to.
        CompensationAcross = 544, Error, "compensation plane is not normal to the tool axis",
            "The control would shift the path along the tool, into the part: a head tilts the tool, a table has turned the plane that CUTCOM names, or another plane is active.",
            "Leave the plane out if the tool is along Z of the control, name the plane normal to the tool if a head has turned it, or compensate in the CAM system.";
        /// A word that an edit takes out, or changes, and that can't be said again.
        EditedWord = 545, Doubt, "editing macro changes a word the post relies on",
            "A macro (_OUTPTP, _MCDWT) or REPLAC removes or changes a word of a block. The next block that needs a word restates most words, but not this one: the post would go on as if it had been output.",
            "Keep the word in the macro, or replace it by another one of its group. To write the program without it, take the record with a FIL section.";
        /// A second frame in one file.
        OtherFrame = 549, Error, "points may be in another coordinate system",
            "CSYS, MSYS and similar words name the coordinate system of the points. If a file names a second one, its points may be in the first system throughout, or in the new one.",
            "Post each clamping from its own file; list the word under words.without_effect if all points are in one system; set input.csys = 1 to convert all points to the first system.";
        /// Something in the wrong mode of a mill-turn machine.
        MillTurn = 561, Error, "not allowed in this mode of a mill-turn machine",
            "MODE/MILL makes the main spindle a rotary axis for live tools; MODE/TURN makes it a spindle again. Each mode excludes functions of the other.",
            "Put MODE/MILL or MODE/TURN before it, or take the record with a FIL section.";
        /// A motion that polar interpolation can't make.
        Polar = 562, Error, "not possible in polar interpolation",
            "Without Y, a live tool along Z mills in the plane of X and C. The mode starts at a rapid move, and the spindle can't jump half a turn where the path crosses the spindle axis.",
            "Put RAPID before the first move, and keep the path away from the spindle axis.";
        /// A motion that cylindrical interpolation can't make.
        Cylinder = 563, Error, "not possible in cylindrical interpolation",
            "A live tool along X that cuts while C turns follows a cylinder of one radius, and its feed applies there.",
            "Cut at one distance from the spindle axis with the tool axis through it, at a feed per minute. Plunge and retract while C is stopped.";
        /// A word within a turn that the control would read another way.
        WayRound = 564, Error, "direction of a rotary axis can't be programmed",
            "The machine counts this axis from 0 to 360 degrees. By its direction rule the axis would turn the other way, or either way.",
            "Add a position in between, or output positions with a clear direction (rotary.output, rotary.zero_sign).";
        /// A feed motion of an axis that can only index.
        Indexing = 565, Error, "feed move of an index-only axis",
            "The axis can only index at rapid from position to position, and can't cut while it rotates (rotary.index_only).",
            "Index it in a RAPID with the tool away from the part, or post for a machine whose rotary axis can feed.";
        /// A move longer than a block may be.
        Departure = 566, Error, "move is longer than a block may be",
            "limits.max_departure is the longest move of one block: straight feed moves are split, others are not.",
            "Bring the tool nearer with a move before it, or correct limits.max_departure.";
        /// A full turn or none.
        ArcNearlyFull = 567, Error, "ambiguous arc: full circle or zero length",
            "The arc ends less than 0.001 mm from its start, but not on it: it is a full circle with a rounding error, or hardly a move at all.",
            "End a full circle exactly at its start, or give its turns with TIMES. Leave out an arc that is shorter than that.";
        /// Too many functions in a block.
        Crowded = 542, Error, "too many G or M codes in one block",
            "The control takes one preparatory function per block, and each of these needs the words of this block.",
            "Set mode.several_g of the machine, or tool.length_z, which activates the tool length offset in a block of its own.";
        /// A pattern of `[effects]` matches.
        EffectPattern = 546, Warning, "a pattern in [effects] matches this block",
            "A pattern may match a block that its author did not think of; filpost then trusts the rule.",
            "List the block itself under [effects], which takes precedence over patterns; [levels] W0546 = \"allow\" silences the warning.";
        /// O0000 or O9001.
        ReservedNumber = 548, Warning, "reserved program number",
            "O0000 is not a program number, and O8000 to O9999 hold the machine builder's macros or protected programs: the control may refuse the program, or overwrite a macro with it.",
            "Change the PARTNO text, or set program.number.";
        /// An author's block within compensation or tool center point control.
        AuthorChange = 547, Doubt, "foreign block changes the state of an active mode",
            "Cutter compensation and TCPC continue after the block with the tool, plane, axes or coordinate system of before. Controls differ in what that does.",
            "Put the block before the mode starts or after it ends.";
        /// Unknown major word.
        UnknownWord = 513, Error, "unknown word",
            "The post has no handler for this major word, and no table lists it as without effect. A misspelt GOTO would lose a motion.",
            "Check its spelling, write a FIL section for it, or list it under words.without_effect in machine.toml.";
        /// Unknown minor word or ignored part.
        IgnoredPart = 552, Warning, "part of the record has no effect",
            "The post acts on the record but not on this part of it.",
            "Remove the part, or take the record with a FIL section.";
        /// Feed or speed clamped.
        Clamped = 553, Warning, "value limited to the machine's range",
            "The feed or speed is outside the machine's range.",
            "Check the value in the CL file and the limits in machine.toml.";
        /// Arc output as lines.
        ArcLines = 554, Warning, "arc written as short lines",
            "The arc is in no plane of the machine, or its radius is above the maximum.",
            "Set circle.chord_tolerance if the lines should be finer; otherwise nothing needs to change.";
        /// A line in steps.
        LineSplit = 557, Warning, "slanted line written in two blocks",
            "The machine moves XY and Z one after the other, so the tool leaves the straight line.",
            "Set linear.method = 0 if the control moves three axes at once; otherwise nothing needs to change.";
        /// Text outside ASCII.
        TapeText = 555, Warning, "non-ASCII text in the program",
            "Many controls read ASCII only and stop at other characters.",
            "Set tape.encoding to the control's code page, or write the message in ASCII.";
        /// Editing without a macro.
        NoEditMacro = 571, Warning, "editing macro is missing",
            "The settings call a macro for each block or line, but no FIL file defines it.",
            "Load the FIL file with the macro, or set tape.edit_macro and tape.block_macro to 0.";
        /// Arcs whose sense nothing proves.
        ArcUnproved = 556, Warning, "arc direction is not certain",
            "CAM systems disagree about the axis of a CIRCLE. By the other rule this arc would be the shorter one, or would continue the path smoothly.",
            "Check the arc in a backplot; choose the dialect of the CL file with --dialect.";
        /// The digits are too coarse.
        CoarseDigits = 590, Warning, "output resolution is coarser than the tolerance",
            "Each axis word is rounded to its last digit; far from a rotary axis this moves the tip.",
            "Increase LINTOL or rotary.tolerance, or give the axes more digits after the decimal point.";
        /// RAPTO beside CLEAR.
        RaptoFromClear = 569, Warning, "R plane is CLEAR minus RAPTO",
            "As Creo's help describes it, RAPTO is measured from CLEAR toward the hole: the tool moves between holes at CLEAR, and the feed starts at CLEAR minus RAPTO above the hole. Earlier versions of filpost used RAPTO as the R plane itself.",
            "Set cycle.rapto = 1 if RAPTO is the R plane above the hole.";
        /// Two tools of one offset.
        SharedOffset = 570, Warning, "two tools share one length offset",
            "The control has one table of length offsets for all tools, and OSETNO gives two tools the same one: it is wrong for one of them.",
            "Give each tool its own offset. Ignore this if both are in the same holder or have the same length.";
        /// Nothing keeps the tip on its line.
        Undivided = 591, Warning, "tool tip leaves its line during a rotary move",
            "With LINTOL / OFF or rotary.tolerance = 0 each rotary move is one block, and so is a feed move right after a tool change. All axes move evenly, and the tip follows a curve.",
            "Set LINTOL or rotary.tolerance, or check the program with `filpost verify --between`.";
        /// A rapid along a leaning tool may not be straight.
        RapidMayBend = 578, Warning, "rapid along a tilted tool may be a dog-leg",
            "With a tilted head, a rapid along the tool moves two or three axes. Some controls move each of them at its own speed, so the tool leaves its line.",
            "Check the control (Fanuc: bit LRP of parameter 1401), and set rapid.straight: 1 straight, 2 dog-leg.";
        /// The length of a tool that lies across Z.
        LengthAcross = 593, Warning, "length offset of a tool lying across Z",
            "The control applies the tool length offset along Z, but the tool of this machine is along another axis.",
            "Check that the control applies the length along the tool axis, or that the offset is 0.";
        /// Straight up in the frame of the machine.
        StraightUp = 594, Warning, "Z retract with a tilted tool",
            "GOHOME, RETRCT or the tool change position is in machine coordinates (home.frame): Z moves straight up while a head tilts the tool.",
            "Retract along the tool with RAPID and GOTO before it. Ignore this if the CL file does.";
        /// The spindle stands in a hole, or a live tool where it cuts.
        SpindleStands = 596, Warning, "cutting with the spindle stopped",
            "SPINDL/OFF, a tool change (M6) or a foreign block stopped the spindle before these holes or this feed move, and nothing has started it since; STOP and OPSTOP stop it on some machines; after MODE/MILL nothing has started the live tool.",
            "Put SPINDL / RPM with a direction before it. Ignore this if the tool does not cut.";
        /// The way out of a bored hole.
        BoreOut = 597, Warning, "retract from a bored hole at feed",
            "The machine has no code for CYCLE/BORE, and controls differ in how the tool leaves the hole: at feed, or at rapid with the spindle stopped.",
            "Set cycle.bore_out: 1 at feed, 2 at rapid with the spindle stopped.";
        /// A tap at the feed of milling.
        TapOfFedrat = 598, Warning, "tap at the feed of FEDRAT",
            "A tap advances by its lead in each revolution. CYCLE/TAP has no feed, so the FEDRAT before it applies, which may be a milling feed.",
            "Give CYCLE / TAP its own feed (MMPM, MMPR, TPI ...).";
        /// The way of an author to a reference point.
        ReferenceWay = 574, Warning, "way to the reference point goes through the part",
            "G28 and G30 go to their axis words first and then to the reference point. Under G90 Z0. is a place in the part, which the tool passes at rapid.",
            "Write G91 G28 Z0. and G90 behind it (on a lathe G28 U0. W0.), or a position above the tool.";
        /// A table turned by an author.
        AuthorTurns = 568, Warning, "foreign block turns a table",
            "POSTN or INSERT turned a table of the machine, and the points after it have no tool axis. The table stays there, and the points are output as they are; a point with its own tool axis turns the table again.",
            "Turn the table back with a block, or with ROTABL and rotary.table_words, unless the points are for this position.";
        /// A tap without HIGH.
        NotRigid = 558, Warning, "tap without HIGH on a machine with rigid tapping",
            "The code of cycle.rigid_tap_mode (M29) synchronizes the spindle with Z. Only CYCLE/TAP,HIGH outputs it; this tap is output for a floating holder.",
            "Write CYCLE/TAP,HIGH for a tap in a rigid holder, in the CL file or in a FIL section for CYCLE.";
        /// Compensation without an offset.
        NoDiameterOffset = 559, Warning, "cutter compensation without a diameter offset",
            "CUTCOM names no offset, and tool.diameter_from_tool = 0 takes none from the tool: G41 or G42 is output without D. Some controls then use the tool in the spindle, others the last D or none.",
            "Write CUTCOM/LEFT,n, or set tool.diameter_from_tool = 1. Ignore this if the control uses the tool in the spindle.";
        /// Holes without a clearance.
        NoClearance = 599, Warning, "rapid down to the start of the holes",
            "CYCLE has neither CLEAR nor RAPTO, and the machine has no clearance of its own (cycle.auto_clearance): the tool goes at rapid to the start of each hole, and from hole to hole at that height.",
            "Give CLEAR. Ignore this if the holes start above the part.";
        /// A machine with a tool list and a tool change, and a CL file without LOADTL.
        NoTool = 721, Warning, "the CL file calls no tool",
            "Neither LOADTL nor a script has called a tool: the program has no tool change and activates no tool length offset. The tool in the spindle moves with whatever offset is active.",
            "Put LOADTL / n before the first motion.";
        /// INCR of ROTATE or ROTABL behind another work offset.
        ShiftedTurn = 722, Doubt, "incremental turn after another work offset",
            "The table was positioned in another work offset. The post counts on from that angle, which is right where both offsets have one zero of the table.",
            "Give the angle from zero: ROTATE / BAXIS, ABSOL, 180.";
        /// A block of the user at a place where it can't stand.
        TextPlace = 723, Error, "block of the settings is not possible here",
            "A block under `[blocks]` in machine.toml names a tool or a work offset that nothing has called yet, or it moves an axis right before rotary axes turn.",
            "Write the number itself, or move the block to another list of `[blocks]`.";
    }
}
