//! Codes of the simulation of material removal (096x and 097x).

fil_diag::codes! {
    /// What a simulation refuses, and what it finds.
    pub enum StockCode {
        /// A tool cuts whose size is not known.
        UnknownTool = 961, Error, "tool without a size",
            "What a tool removes depends on its diameter, corner radius and point, which are not in an NC program.",
            "Give its size, such as `--tool 1=D10R0.5L50`, or the CL file with `--cl`.";
        /// A motion that can't be simulated.
        NotSimulated = 962, Error, "move can't be simulated",
            "The simulation handles a mill with three axes in one coordinate system and the tool upright, and a lathe with inserts and drills on the spindle axis. It would be wrong for this program.",
            "Simulate only the part of the program with the tool upright and one work offset.";
        /// A grid with too many cells.
        TooFine = 963, Error, "grid is too fine for the stock",
            "Each cell of the grid takes memory. The number of cells is limited to 40 million.",
            "Choose a larger cell, such as `--grid 0.5`.";
        /// A file that is no STL.
        BadMesh = 964, Error, "STL file can't be read",
            "The file is neither ASCII nor binary STL, was cut off, or has no triangle.",
            "Export the model again as STL, in mm.";
        /// A description of stock or tool that can't be read.
        BadDescription = 965, Error, "description of stock or tool can't be read",
            "Stock is a box, a cylinder, a tube, `auto` or an STL file; a tool is letters with numbers.",
            "Write `box 100x80x30 at 0,0,-30`, `cylinder 60x100`, or a tool as `D10R0.5L50H40x60`.";
        /// The tool goes through material at rapid.
        RapidInStock = 971, Doubt, "rapid through stock",
            "The tool touches material at rapid: it breaks, or moves the part.",
            "Retract higher before the move, or clear the path first. A stock larger than the real one also causes this.";
        /// The holder touches material.
        HolderInStock = 972, Doubt, "holder in stock",
            "The tool goes deeper than it sticks out of its holder, next to material that is still there.",
            "Clamp the tool longer (L), use a smaller holder (H), or rough the wall first.";
        /// Cutting while the spindle stands.
        SpindleStands = 973, Doubt, "cutting while the spindle is stopped",
            "The tool moves into material at feed while no spindle is on.",
            "Write SPINDL before the cut, and again after a record or block that stops the spindle.";
        /// Deeper than the part.
        BelowPart = 974, Doubt, "cut into the finished part",
            "The tool removes material that belongs to the given part.",
            "Check the depth, the corner radius and the tool length offset; `--part-tol` allows for coarse STL files.";
        /// Plunging with a tool that has no teeth at its center.
        CenterPlunge = 975, Warning, "plunge with a non-center-cutting tool",
            "The tool goes straight down into material, and has no teeth at its center (C).",
            "Enter by a ramp or a helix, or drill the point first.";
        /// Cutter compensation is on.
        Compensated = 976, Warning, "cutter compensation simulated with offset 0",
            "The offset value is in the control. The simulation takes the programmed path as the path of the tool center.",
            "Nothing to change if the CAM system outputs the tool center path; otherwise the real cut is one tool radius beside the simulated one.";
        /// Motions at feed from an unknown position.
        UnknownStart = 977, Warning, "cut from an unknown position",
            "The position before the move is unknown, so the move is not simulated.",
            "Position all axes at rapid before the first cut, and again after a move in machine coordinates and a new work offset.";
        /// A live tool or the sub-spindle of a lathe.
        NotTurning = 978, Warning, "live tool or sub-spindle move is not simulated",
            "The simulation of a lathe turns and drills in the main spindle. What live tools mill, and what is cut in the sub-spindle, stays in its stock.",
            "Check these blocks with the plot or a dry run; `--deny W0978` fails on them.";
    }
}
