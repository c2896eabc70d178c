//! Codes of the post (05xx) and of machine settings (06xx).

fil_diag::codes! {
    /// Everything the post refuses or warns about.
    pub enum PostCode {
        /// Motion without position.
        ArcStart = 503, Error, "arc without a start point",
            "An arc starts where the motion before it ended, and no motion came before, or the machine \
             stands elsewhere: behind a cycle, a text, TRANS, or a FROM between motions.",
            "Put a GOTO before the CIRCLE, after all that moves the axes otherwise.";
        /// Radii disagree.
        ArcRadius = 504, Error, "the radii of the arc disagree",
            "Start and end of an arc must lie at the same distance from its center.",
            "Check center, start and end of the CIRCLE and the GOTO after it.";
        /// CIRCLE without GOTO.
        ArcEnd = 505, Error, "CIRCLE without an end point",
            "A CIRCLE takes its end from the GOTO that follows at once.",
            "Put the GOTO of the end point after the CIRCLE.";
        /// A word form.
        WordForm = 506, Error, "form of this post word is not understood",
            "What can't be read for sure is not guessed: the block would be a guess too.",
            "Compare the record with the documented forms of the word.";
        /// What the language of the control can't say.
        Family = 560, Error, "the language of the control has no word for this",
            "Controls of other families have no G functions of their own choice, no skip mark, or no such cycle; what they can't say is not left out.",
            "Take the record with a FIL section and write with INSERT what the control shall do.";
        /// A missing code.
        NoCode = 507, Error, "the machine has no code for this",
            "The setting that holds the preparatory or auxiliary function is absent.",
            "Set the code in machine.toml, or take the record with a FIL section.";
        /// Feed motion without feed.
        NoFeed = 509, Error, "feed motion without a feed",
            "A feed motion needs a feed, and none was given before it.",
            "Put a FEDRAT before the first GOTO that is not rapid.";
        /// Sequence of cycle.
        CycleForm = 511, Error, "cycle can't be carried out",
            "A value the cycle needs is missing or makes no sense.",
            "Give DEPTH, a feed and CLEAR (and STEP for DEEP and BRKCHP).";
        /// No unit.
        NoUnit = 514, Error, "the unit is not known",
            "A length or feed means nothing before the CL file, the machine or the user says mm or inch.",
            "Put UNITS / MM or UNITS / INCHES first, give --units mm or --units inch, or set units.mode of the machine (1 inch, 2 mm).";
        /// UNITS in mid-file.
        UnitChange = 515, Error, "the unit changes in mid-file",
            "Positions, feeds and limits given before would be read in the other unit; and of two statements that differ one is wrong.",
            "Keep one unit in a CL file.";
        /// Units that contradict each other.
        Units = 715, Error, "units contradict each other",
            "The unit that was given with --units, what the CL file says and what the machine takes must be the same.",
            "Leave out --units where the CL file says UNITS, or correct units.mode of the machine.";
        /// Blocks after the end.
        AfterEnd = 516, Error, "block after the end of the program",
            "The control stops at M2 or M30 and never reads what comes after it.",
            "Move END or REWIND behind the last record that writes.";
        /// A character that must not reach the tape.
        TextCharacter = 517, Error, "character that must not reach the tape",
            "A percent sign ends the tape, and a control character may do anything.",
            "Take the character out of the text.";
        /// A program number.
        ProgramNumber = 518, Error, "program number out of range",
            "A program number has four digits on most controls, five or eight on some, and never more.",
            "Set another program.number.";
        /// Compensation left on.
        CompensationOn = 519, Error, "cutter compensation is still on",
            "The control would go on to compensate with another tool, or alarm.",
            "Put CUTCOM / OFF before it.";
        /// Compensation on an arc.
        CompensationOnArc = 520, Error, "cutter compensation begins or ends on an arc",
            "Controls take up and give up the offset on a straight line only.",
            "Put a straight motion between CUTCOM and the CIRCLE.";
        /// Compensation of a path in a mirror.
        CompensationSide = 530, Error, "left of the path is right of it on the tape",
            "In a mirror, and seen from below, the tool would cut on the other side of the path.",
            "Let the CAM system mirror the path, its compensation with it, or take CUTCOM with a FIL section that says the side on the tape.";
        /// Compensation that is lost.
        CompensationLost = 521, Doubt, "cutter compensation is no longer certain",
            "A text that can't be read may have switched it, and saying it again would begin it anew.",
            "Put the text before CUTCOM or after CUTCOM / OFF.";
        /// Something in a cycle.
        InCycle = 522, Error, "not in an active cycle",
            "The next GOTO would drill a hole, and the control would be in its cycle.",
            "Put CYCLE / OFF before it.";
        /// Sense of an arc.
        ArcSense = 523, Error, "the arc seems to turn the wrong way",
            "CAM systems disagree about the axis of a CIRCLE; read in the wrong dialect every arc turns the other way.",
            "Choose the dialect of the CL file with --dialect; write an arc that is right as it is as lines.";
        /// A tool that lies across Z.
        Leaning = 538, Error, "the tool lies across Z",
            "Z alone would move the tool sideways, through the part where it stands in it.",
            "Bring the tool out by RAPID and GOTO, and turn it upright there.";
        /// A second tool, or zero, with which the machine turns.
        TurnedApart = 539, Error, "the machine turns for another tool or zero",
            "Positions of the axes hold the distance from the pivot of a head to the tip, and from the zero to the axis of a table. Both are stated once for the machine.",
            "Post with tool-tip control or in tilted frames, where the control knows both; or one program each. Levels of the machine's Z: turn the tool upright before them, or set home.frame = 1.";
        /// A rotary axis the long way round.
        Unwinding = 524, Error, "a rotary axis would unwind while cutting",
            "Its limits leave only another way to the tool axis, and the tool would cut on the way.",
            "Have the tool retract there (repos.retract_distance with repos.feed_method = 1 or a macro _REPOS), retract before it in the CL file, or give the axis more travel.";
        /// A limit that nothing leads past.
        NoAlternative = 527, Error, "a rotary axis is at its limit, and nothing leads on",
            "The tool would retract, the machine turn to other positions for the same tool axis, and the tool return; here there are none from which the motion goes on, or the way out is not known.",
            "Give repos.retract_distance, give the axis more travel, or divide the path in the CAM system and retract between its parts.";
        /// A pole at feed.
        Pole = 528, Error, "a pole of the machine lies on a feed motion",
            "Beside the direction of a rotary axis the machine turns far for a small change of the tool axis, and the tool leans out of the plane of its ends on the way.",
            "Have the CAM system give more points there or keep the tool axis away from the pole; rotary.axis_tolerance is what is allowed, 0 looks at none.";
        /// A retract at a limit.
        Repositioned = 529, Warning, "the tool retracts at the limit of a rotary axis",
            "The machine turns to other positions for the same tool axis, and the tool comes back to the same point.",
            "Look whether the retract is far enough for the part to turn; repos.feed_warning = 0 says nothing.";
        /// A motion outside of the travel that the machine allows.
        BeyondTravel = 586, Warning, "X, Y or Z leaves its travel",
            "repos.check_linear lets the axis go there with a warning (repos.x_exceeded to repos.z_exceeded = 2); without it the motion would be refused.",
            "Look whether the machine gets there, move the part, or let the machine take other positions of its rotary axes there (1).";
        /// A rapid motion to other positions than the nearest.
        RapidRepositioned = 587, Warning, "a rapid motion takes other positions of the rotary axes",
            "The nearest positions for the tool axis lie past a limit, or the motions behind a RAPID would come to one from there.",
            "Look whether the tool is clear of the part while the machine turns; repos.rapid_retract = 1 takes it out before, repos.rapid_warning = 0 says nothing.";
        /// What a look-ahead has tried.
        LookAhead = 595, Warning, "what the look-ahead of a RAPID has tried",
            "repos.optimise_trace lists for each RAPID from which positions of the rotary axes the motions behind it meet how many limits and poles, and which are taken.",
            "Nothing is wrong; repos.optimise_trace = 0 lists nothing.";
        /// Length of a tool axis.
        AxisLength = 525, Error, "not a tool axis",
            "A tool axis has length 1; six values of another length may be two points. After MULTAX / OFF there is none but 0,0,1.",
            "Check the GOTO; MULTAX / ON allows axes of any length but zero.";
        /// A part on both sides of a skip mark.
        SkippedPart = 526, Error, "part of a command stands in blocks that may be skipped",
            "With the skip switch on the control would get one half of it only.",
            "Put the whole command on one side of OPSKIP.";
        /// A motion that is safe at one position of the skip switch only.
        SkippedLevel = 531, Error, "no way is safe with the skipped blocks and without them",
            "The skip switch decides where the tool stands behind OPSKIP / OFF. Which axes go first, and which level is the one before a cycle, would be right for one of the two places only.",
            "Put a RAPID to a level that is above both behind OPSKIP / OFF, and one to a known level before OPSKIP / ON.";
        /// A rapid motion from a height that is not known.
        UnknownLevel = 532, Doubt, "a rapid motion from a height that is not known",
            "A text, a call of a subprogram or another zero came before it, and the post can't tell whether the tool stands above the end of the motion or below. Up first could be a plunge, across first could go through the part.",
            "Put GOHOME or RETRCT before it, LOADTL, a text that goes to the machine's reference point (G91 G28 Z0.), or RAPID with a GOTO straight up; before a change of the work offset go up with RAPID.";
        /// A rapid motion at a height that counts from another zero.
        ShiftedLevel = 533, Warning, "a rapid motion across behind another zero",
            "The work offset or the length of the tool has changed since the tool was brought to its height. How high it stands above the part is in the tables of the control, not in the CL file.",
            "Look whether the tool is clear of both zeros there; GOHOME, RETRCT or LOADTL before the change leaves no doubt.";
        /// A feed a turn of a spindle that stands.
        FeedStands = 534, Error, "feed a turn with the spindle standing",
            "The control counts the feed in turns of the spindle, and waits for them where it stands.",
            "Put SPINDL / RPM with a direction before it, or give the feed a minute.";
        /// A motion at feed of a rotary axis that may stand anywhere.
        UnknownTurn = 535, Doubt, "a motion at feed from where a rotary axis may stand anywhere",
            "A text or a call of a subprogram came before it and may have turned the axis: the motion would turn it back at feed by any angle, and the tip would leave its line.",
            "Put RAPID and a GOTO before it, which turns the axis to where it belongs, or a text that says where it stands (G0 A0.).";
        /// A motion without the length of the tool.
        LengthTaken = 536, Doubt, "a motion without the length of the tool",
            "A text has taken the length of the tool off, or changed the tool without calling its length. Z of the CL file counts from the tip, and the control would bring the spindle nose there, or the tip by the length of another tool.",
            "Let the text, or another one behind it, call the length again (G43 H1, on a SINUMERIK D1), or put LOADTL before the motion.";
        /// Another work offset than that of the CL file.
        OtherOffset = 550, Warning, "a block of an author replaces the work offset of the CL file",
            "SET/OFSETL has chosen a work offset, and a text, a POSTN or a machine block has another one: what follows is cut from another zero than the CL file asks for.",
            "Leave the work offset out of the text, or put SET/OFSETL behind it.";
        /// A program number within a program.
        SecondProgram = 551, Warning, "a second program number",
            "The post has written a program number, and a text begins another program before the end of this one. A control that reads the file stores two programs, the first one without an end.",
            "Say the number by PARTNO or program.number and leave it out of the text, or set program.number_address = \"none\"; a subprogram belongs behind the end of the program.";
        /// A rotary axis that is clamped.
        TurnsClamped = 537, Error, "a clamped rotary axis would turn",
            "CLAMP/ON or a text has clamped the rotary axes, and nothing has released them since: the drive would turn against the brake, or the control would stop.",
            "Put CLAMP / OFF before the motion that turns the machine.";
        /// A rapid along a leaning tool that is not straight.
        RapidBends = 540, Error, "rapid that is not straight along a leaning tool",
            "Along a tool that a head leans a rapid block moves two or three axes, and this control drives each of them at its own speed (rapid.straight = 2), so that the tool would leave its line, into the part.",
            "Let the CAM system write these ways at feed, or switch the control to straight rapid motions and say rapid.straight = 1.";
        /// A block that is too long.
        BlockLength = 541, Error, "block longer than the control reads",
            "The rest of a block that is longer than the control's buffer would be lost.",
            "Shorten the text, drop blanks with tape.blank, or correct tape.max_block of the machine.";
        /// A letter that the encoding of the tape lacks.
        TapeLetter = 543, Error, "letter that the encoding of the program lacks",
            "The program is written in a code page of the control (tape.encoding), which has no byte for this letter. Another letter in its place would say something else.",
            "Write the text with letters of that page, choose the page of the control with tape.encoding, or have all texts in ASCII with tape.characters = 1.";
        /// Blocks without a motion under compensation.
        StillBlocks = 572, Warning, "blocks without a motion in cutter compensation",
            "Several blocks that move nothing in the plane of compensation (M functions, a dwell, a stop, a depth) stand between two motions under G41 or G42. A control that reads few blocks ahead does not see the second motion then, and cuts too much or too little at the corner.",
            "Put what stands between before CUTCOM or behind CUTCOM/OFF; ignore this where the control reads as many blocks ahead, or the path goes straight on.";
        /// A feed a turn, of one of two spindles.
        FeedOfSpindle = 573, Warning, "a feed a turn beside the second spindle",
            "The second spindle turns by spindle.side_cw_code, and no setting says which spindle the control counts: a feed a turn may be that of the main one, which stands or turns at another speed.",
            "Set spindle.side_master_code and spindle.main_master_code (a SINUMERIK: spindle.side_number), or give feeds a minute; ignore this where the codes of the second spindle make the control count it.";
        /// A motion of too many parts.
        TooManyParts = 580, Error, "a motion would be divided too often",
            "While rotary axes turn, the tip leaves its line; to keep it there, or to say its feed, takes too many blocks. So do the lines of an arc of many turns.",
            "Give a larger LINTOL, rotary.tolerance or circle.chord_tolerance, fewer TIMES, or a higher feed; check that the part lies near the rotary axes.";
        /// A feed a revolution while the machine turns.
        RotaryFeedUnknown = 581, Error, "feed of a motion that turns the machine is not known",
            "The time of such a motion is found from the way of the tip and its feed a minute.",
            "Put SPINDL before it, or give the feed in MMPM or IPM.";
        /// A thread and a turn.
        ThreadTurns = 582, Error, "the machine would turn while a thread is cut",
            "The block of a thread moves X, Y and Z only.",
            "Put the change of the tool axis before or after the thread.";
        /// Surface speed without a limit.
        SpeedLimit = 583, Error, "surface speed without a highest speed",
            "At constant surface speed the spindle turns faster the nearer the tool comes to its axis; what stops it must be said before.",
            "Give SPINDL / MAXRPM, or spindle.css_limit; where the control limits it by itself, spindle.css_unlimited = 1.";
        /// A speed above MAXRPM.
        AboveSpeedLimit = 592, Warning, "spindle speed above the highest speed in force",
            "The highest speed that MAXRPM has set stays in force until another one comes. Many controls hold each speed of the spindle to it, so that it may turn slower than asked for.",
            "Give SPINDL its own MAXRPM, at or above the speed.";
        /// No such station.
        Station = 584, Error, "the turret has no such station",
            "The number of the tool is above that of the last station, and the turret would turn to another one, or alarm.",
            "Correct the number of the tool, or turret.stations of the machine.";
        /// A thread that can't be cut.
        Thread = 585, Error, "thread can't be cut",
            "A value the thread needs is missing or makes no sense, or the machine is in a mode in which no thread can be cut.",
            "Give a lead, a depth and passes above zero, two points of the crest, and turns of the spindle (SPINDL / RPM), without cutter compensation.";
        /// Something under tool-tip control.
        TipControl = 588, Error, "not under tool-tip control",
            "The control needs the length of the tool for it, and ends it only where the machine may turn its tables back to zero.",
            "Put LOADTL before it, or write positions of the axes with rotary.tip_output = 0.";
        /// Something in a tilted frame.
        Frame = 589, Error, "not in a tilted frame",
            "A tilted frame stands still, and the machine turns to it only where the tool is away from the part.",
            "Put LOADTL, GOHOME or RETRCT before the new tool axis, give home.retract_z, or write positions of the axes with rotary.frame_output = 0.";
        /// Compensation in a plane that the tool is not square to.
        CompensationAcross = 544, Error, "cutter compensation across the tool",
            "The tool does not lie square to the plane in which the control compensates it, so that the path would be shifted along the tool, into the part: a head leans it, a table has turned the plane that CUTCOM names, or the plane of the program is another one.",
            "Leave the plane out where the tool stands along Z of the control, name the plane that it is square to where a head has turned it, or let the CAM system compensate.";
        /// A word that an edit takes out, or changes, and that can't be said again.
        EditedWord = 545, Doubt, "an editing macro changes what the post goes on from",
            "A macro (_OUTPTP, _MCDWT) or REPLAC takes a word out of a block or changes it. Most words are said again by the next block that needs them; this one can't be: what follows would be carried out as if it stood.",
            "Let the macro leave the word as it is, or put another of its kind in its place; take the record with a FIL section where the program shall be without it.";
        /// A second frame in one file.
        OtherFrame = 549, Error, "the points may be of another frame",
            "CSYS, MSYS and their like name the frame of the points. Where a file names a second one, its points may be those of the part all through or those of the new frame.",
            "Post each clamping from a file of its own; list the word under words.without_effect where all points are of one frame; input.csys = 1 moves the points of each frame into the first.";
        /// Something in the wrong mode of a mill-turn machine.
        MillTurn = 561, Error, "not in this mode of a mill-turn machine",
            "MODE/MILL makes the main spindle an axis that live tools mill by; MODE/TURN makes it a spindle again. What belongs to one of the two can't be done in the other.",
            "Put MODE/MILL or MODE/TURN before it, or take the record with a FIL section.";
        /// A motion that polar interpolation can't make.
        Polar = 562, Error, "not in polar interpolation",
            "Without Y a live tool along Z mills in the plane of X and C. That begins at a rapid motion, and the spindle can't turn by half a turn at once where the path crosses its axis.",
            "Put RAPID before the first motion, and keep the path away from the axis of the spindle.";
        /// A motion that cylindrical interpolation can't make.
        Cylinder = 563, Error, "not on a cylinder about the spindle",
            "A live tool along X that cuts while C turns goes along a cylinder of one radius, and its feed counts there.",
            "Cut at one distance from the axis of the spindle with the tool axis through it, at a feed a minute; plunge and retract while C stands.";
        /// A word within a turn that the control would read another way.
        WayRound = 564, Error, "which way a rotary axis turns can't be written",
            "The machine counts the positions of this axis from 0 to 360 degrees, and by its way to read them the axis would turn the other way round, or which way is left open.",
            "Go there by a position in between, or write positions that the control reads in one way (rotary.output, rotary.zero_sign).";
        /// A feed motion of an axis that can only index.
        Indexing = 565, Error, "the axis can only index",
            "The machine turns this axis at rapid, from one position to the next, and can't cut while it turns (rotary.index_only).",
            "Turn it in a RAPID, with the tool away from the part, or post for a machine whose axis can feed.";
        /// A move longer than a block may be.
        Departure = 566, Error, "a move is longer than a block may be",
            "The machine says how far one block may go (limits.max_departure): motions at feed in a straight line are divided, others are not.",
            "Bring the tool nearer by a motion before it, or correct limits.max_departure.";
        /// A full turn or none.
        ArcNearlyFull = 567, Error, "an arc that is a full turn or none",
            "The arc ends less than 0.001 mm beside its start, but not there: as it stands it is a full turn but for a rounding, or no motion to the last digit.",
            "Let the CAM system end a full circle exactly where it begins, or say its turns by TIMES; leave an arc out that is shorter than that.";
        /// Too many functions in a block.
        Crowded = 542, Error, "functions that the control does not take in one block",
            "The control takes one preparatory function in a block, and each of these needs the words that stand there.",
            "Set mode.several_g of the machine, or tool.length_z, which calls the tool length in a block of its own.";
        /// A pattern of `[effects]` matches.
        EffectPattern = 546, Warning, "a pattern of [effects] says what a block does",
            "A pattern may match a block that its author did not think of; what the rule says is then taken for granted.",
            "Write the block itself under [effects], which goes before a pattern; [levels] W0546 = \"allow\" silences the warning.";
        /// O0000 or O9001.
        ReservedNumber = 548, Warning, "a program number that controls keep for others",
            "O0000 is no number of a program, and O8000 to O9999 are macros of the machine's builder or protected programs: the control may refuse the program, or lose a macro by it.",
            "Change the PARTNO text, or set program.number.";
        /// An author's block within compensation or tool center point control.
        AuthorChange = 547, Doubt, "an author's block changes what an active mode counts on",
            "Cutter compensation and tool center point control go on behind the block with the tool, plane, axes or frame of before. Controls differ in what that does.",
            "Put the block before the mode begins or behind its end.";
        /// Unknown major word.
        UnknownWord = 513, Error, "unknown word",
            "The post has no handler for this major word, and no table lists it as without effect. A misspelt GOTO would lose a motion.",
            "Check its spelling, write a FIL section for it, or list it under words.without_effect in machine.toml.";
        /// Unknown minor word or ignored part.
        IgnoredPart = 552, Warning, "part of the record has no effect",
            "The post acts on the record but not on this part of it.",
            "Remove the part, or take the record with a FIL section.";
        /// Feed or speed clamped.
        Clamped = 553, Warning, "value brought within the machine's limits",
            "The feed or speed asked for lies outside the range of the machine.",
            "Check the value in the CL file and the limits in machine.toml.";
        /// Arc output as lines.
        ArcLines = 554, Warning, "arc written as short lines",
            "The arc lies in no plane of the machine, or its radius is above the maximum.",
            "Nothing to do if the chord tolerance suits; see circle.chord_tolerance.";
        /// A line in steps.
        LineSplit = 557, Warning, "slanted line written in two blocks",
            "The machine moves XY and Z one after the other, so the tool leaves the straight line.",
            "Nothing to do where the control can't move three axes at once; else set linear.method to 0.";
        /// Text outside ASCII.
        TapeText = 555, Warning, "text on the tape that is not ASCII",
            "Many controls read ASCII only and stop at other characters.",
            "Set tape.encoding to the code page of the control, or write the message in ASCII, if it is not known to read UTF-8.";
        /// Editing without a macro.
        NoEditMacro = 571, Warning, "no macro edits the blocks",
            "The settings have the post call a macro with each block or line, and no FIL file has it.",
            "Load the FIL file with the macro, or set tape.edit_macro and tape.block_macro to 0.";
        /// Arcs whose sense nothing proves.
        ArcUnproved = 556, Warning, "the sense of an arc is not proved",
            "CAM systems disagree about the axis of a CIRCLE, and by the other rule this arc would be the shorter way round or run on.",
            "Look at the arc in a backplot; choose the dialect of the CL file with --dialect.";
        /// The digits are too coarse.
        CoarseDigits = 590, Warning, "the tape is too coarse for the tolerance",
            "Each axis word is rounded to its last digit, and far from a rotary axis that moves the tip.",
            "Give a larger LINTOL or rotary.tolerance, or the axes more digits after the point.";
        /// RAPTO beside CLEAR.
        RaptoFromClear = 569, Warning, "the R level is CLEAR less RAPTO",
            "RAPTO is measured from CLEAR toward the hole, as the help of Creo says: the tool travels between holes at CLEAR, and the feed begins at CLEAR less RAPTO above the hole. Earlier versions of filpost took RAPTO as the R level itself.",
            "Nothing to do where that is meant; else set cycle.rapto = 1, by which RAPTO is the R level above the hole.";
        /// Two tools of one offset.
        SharedOffset = 570, Warning, "two tools with one length offset",
            "The control has one table of length offsets for all tools, and OSETNO names the same offset for two tools: one of them is not as long as its offset says.",
            "Give each tool an offset of its own; ignore this where both are the same holder, or are measured to one length.";
        /// Nothing keeps the tip on its line.
        Undivided = 591, Warning, "the tip leaves its line while the machine turns",
            "LINTOL / OFF or rotary.tolerance = 0 lets motions that turn the machine be one block each, as one at feed right behind a tool change is; all axes go evenly, and the tip goes along a curve.",
            "Give LINTOL or rotary.tolerance a value, or check the program with filpost verify --between.";
        /// A rapid along a leaning tool may not be straight.
        RapidMayBend = 578, Warning, "rapid while a head leans the tool",
            "Along a tool that a head leans a rapid block moves two or three axes, and some controls drive each of them at its own speed there, so that the tool leaves its line.",
            "Look what the control does (on a Fanuc bit LRP of parameter 1401), and say it with rapid.straight: 1 is straight.";
        /// The length of a tool that lies across Z.
        LengthAcross = 593, Warning, "the length of a tool that lies across Z",
            "The control counts the length offset along Z, and the tool of this machine lies along another axis.",
            "Look whether the control counts the length along the axis of the tool, or the offset is 0.";
        /// Straight up in the frame of the machine.
        StraightUp = 594, Warning, "straight up while the tool leans",
            "GOHOME, RETRCT or the change position is one in the frame of the machine (home.frame), Z goes there straight, and a head leans the tool.",
            "Bring the tool out along itself by RAPID and GOTO before it; ignore this where the CL file has.";
        /// The spindle stands in a hole, or a live tool where it cuts.
        SpindleStands = 596, Warning, "cutting with the spindle standing",
            "SPINDL/OFF, a tool change (M6), or a text that stops the spindle came before these holes or this motion at feed, and nothing has turned it since; or STOP or OPSTOP, which stop it on some machines; or MODE/MILL, and nothing has turned the live tool.",
            "Put SPINDL / RPM with a direction before it; ignore this where the tool does not cut.";
        /// The way out of a bored hole.
        BoreOut = 597, Warning, "bored hole left at feed",
            "The machine has no code for CYCLE/BORE, and controls differ in how the tool leaves such a hole: at feed, or at rapid with the spindle standing.",
            "Say it with cycle.bore_out: 1 at feed, 2 at rapid with the spindle standing.";
        /// A tap at the feed of milling.
        TapOfFedrat = 598, Warning, "tap at the feed of FEDRAT",
            "A tap moves by its lead for each turn of the spindle. CYCLE/TAP names no feed, so that of the FEDRAT before it is taken, which may be that of milling.",
            "Give CYCLE / TAP its own feed (MMPM, MMPR, TPI ...).";
        /// A table turned by an author.
        AuthorTurns = 568, Warning, "a block of an author turns a table",
            "POSTN or INSERT has turned a table of the machine, and the points of the CL file behind it have no tool axis. The table stays where the block has turned it, and the points are written as they are; a point with a tool axis of its own turns it by that axis.",
            "Nothing to do where the points count so; else turn the table back by a block, or by ROTABL with rotary.table_words.";
        /// A tap without HIGH.
        NotRigid = 558, Warning, "tap without HIGH on a machine with rigid tapping",
            "The code of cycle.rigid_tap_mode (M29) brings the spindle in step with Z. It comes with CYCLE/TAP,HIGH; this tap is one of a floating holder.",
            "Write CYCLE/TAP,HIGH where the tap is in a rigid holder, in the CL file or in a FIL section of CYCLE.";
        /// Compensation without an offset.
        NoDiameterOffset = 559, Warning, "cutter compensation without a diameter offset",
            "CUTCOM names no offset, and tool.diameter_from_tool = 0 takes none from the tool: G41 or G42 is written without D. Some controls then take the tool in the spindle, others the last D or none.",
            "Write CUTCOM/LEFT,n, or set tool.diameter_from_tool to 1; ignore this where the control takes the tool in the spindle.";
        /// Holes without a clearance.
        NoClearance = 599, Warning, "rapid to the start of the holes",
            "CYCLE names neither CLEAR nor RAPTO, and the machine has no clearance of its own (cycle.auto_clearance): the tool goes at rapid down to the start of each hole, and from hole to hole on that level.",
            "Give CLEAR; ignore this where the holes start above the part.";
    }
}
