// SPDX-License-Identifier: Apache-2.0
#include "cell/codes.hpp"

#include <algorithm>
#include <array>

namespace plumb::offline {
namespace {

constexpr auto kCodes = std::to_array<CodeHelp>({
    {"E-BUG",
     "Something that cannot happen did. Please report it with the command line and, if you "
     "may, the files."},
    {"E-CELL-EARLIER",
     "[fit] prior_from, or --from, names a run of an arm: a folder of a cell that was fitted, or "
     "of "
     "one of its runs. The run must be whole, as it was written, fitted to the arm of its cell and "
     "not to the controller's own positions."},
    {"E-CELL-EFFECT",
     "[effects] names something that is not in the catalogue; plumb explain lists what is. It is "
     "refused rather than ignored, so that a model never lacks what its cell file promises. "
     "Correct the name or delete the table."},
    {"E-CELL-EFFECTS-LAYOUT",
     "add, drop and diagnose --apply change [effects] where it stands and keep the rest of the "
     "file, but this one is laid out in a way they do not follow, effects as inline tables over "
     "several lines for example. Nothing was written. Give each effect a table of its own: "
     "[effects.joint_compliance]."},
    {"E-CELL-HELD",
     "[measurement] held_out says which poses are kept away from the fit. It is one of \"auto\" "
     "(the rows that column 'set' marks as held; without such marks five folds of up to 500 "
     "poses, and 20 % of more), \"20%\", \"kfold:5\", \"column:set\" (the column "
     "'set' holds fit, held or ignore) and \"file:verify.csv\"."},
    {"E-CELL-JOINT",
     "A joint is referred to by the name it has in [robot] joints, \"J2\" for example. Correct the "
     "name; upper and lower case differ."},
    {"E-CELL-KEY",
     "Keys that are not known are errors: a misspelt key would otherwise be silently without "
     "effect. Rename it as proposed, or delete it."},
    {"E-CELL-MISSING",
     "A key without which the arm is not described: schema, [robot], dh_convention (standard and "
     "modified rows look alike and mean different arms, so it is never guessed), joints."},
    {"E-CELL-NONE",
     "Every verb works in the nearest folder upward that holds a cell.toml. Go to a cell, name it "
     "with -C DIR, make one with plumb new, or try plumb demo."},
    {"E-CELL-PRIOR",
     "[fit] prior_from names the fleet.json that plumb fleet writes, which must hold arms with the "
     "DH values of this cell, and numbers that arms can have."},
    {"E-CELL-RANGE",
     "The value has the right type but cannot be meant: joint limits must rise, standard "
     "deviations and tolerances be greater than 0, all numbers finite, names unique. The label "
     "under the caret says which rule was broken."},
    {"E-CELL-SCHEMA",
     "The first line of a cell file names its format: schema = \"cell/1\". Another one was written "
     "for another version of the program."},
    {"E-CELL-SETUP",
     "[[measurement.setup]] describes one arrangement of tracker and reflector in which the arm "
     "was "
     "measured: a name of its own, the files measured in it (each file in one set-up), and frame "
     "and target, which may also be those of a set-up further up: frame = { same_as = \"day 1\" "
     "}."},
    {"E-CELL-TYPE",
     "The value has the wrong type: numbers stand without quotes, texts in quotes, lists in "
     "[brackets], tables in { braces }. The label under the caret says what is expected."},
    {"E-CSV-AXIS",
     "Standard deviations (sx_um …) and the controller's own positions (nx_mm …) are given for "
     "every measured axis or for none. Complete the columns or delete them."},
    {"E-CSV-BINARY",
     "A measurement file is text, and this one holds zero bytes: a spreadsheet or an archive, "
     "perhaps. Save the table as CSV in UTF-8."},
    {"E-CSV-CONTEXT",
     "A value that cannot be: a direction dir_jN is 1, -1 or 0 (not known), the size of a travel "
     "and "
     "a payload are 0 or more, a temperature lies above -273.15 degC."},
    {"E-CSV-DUPLICATE",
     "Two columns mean the same quantity, for example q1_deg and q1_rad. Delete one: nothing says "
     "which is right."},
    {"E-CSV-EMPTY", "The file holds nothing, or only comments. Export the measurements again."},
    {"E-CSV-FAR",
     "A joint beyond 10,000 rad or m, or a point more than 10 km away, is no reading of an arm: "
     "the "
     "column's unit is not the one in its name, or a decimal point was lost."},
    {"E-CSV-HEADER",
     "Every column has a name. A comma at the end of the header makes one too many."},
    {"E-CSV-JOINT",
     "Joint positions are the columns q1 … qN with a unit, one for each joint of [robot] joints: "
     "no "
     "gap and none beyond. In targets they may be missing altogether."},
    {"E-CSV-KIND",
     "The unit does not fit the quantity: a position in deg, or a turning joint in mm. Rename the "
     "column if only the suffix is wrong; correct the joint's type in cell.toml if it slides."},
    {"E-CSV-LINE",
     "A line of more than a megabyte is no row of measurements: the file is something else, or its "
     "line breaks were lost. Nothing beyond that line was read."},
    {"E-CSV-MISSING",
     "A numeric cell, or a pose's name, is empty. Fill it, or delete the row: a reading that was "
     "not taken must not count as zero."},
    {"E-CSV-MIXED",
     "The files of one cell measure different axes. Joined, they would hold positions nobody "
     "measured. Complete the files, or give each its own cell."},
    {"E-CSV-NAN",
     "Infinite values and NaN are no measurements. Delete the row, or set it to ignore in the "
     "column 'set' with a finite value."},
    {"E-CSV-NONE", "The cell names no measurement file: [measurement] files is empty."},
    {"E-CSV-NUMBER",
     "A numeric cell holds something else. Decimals have a point; with ';' between columns a comma "
     "is accepted too. Thousands are not grouped. Notes belong in the column 'note'."},
    {"E-CSV-ORIENTATION",
     "A measured orientation is all of qw, qx, qy, qz, or all of rx, ry, rz with a unit, and only "
     "one of the two."},
    {"E-CSV-POINT",
     "The column 'point' says in every row which fixed point the tool touches: rows with one label "
     "touch one point. In the same way 'plane', 'sphere' and 'anchor' name what the other readings "
     "without a tracker are about; a file has one of them. 'height_mm' is how far the tool is "
     "above "
     "the plane, 'radius_mm' is that of the sphere, the same in all of its rows, and 'distance_mm' "
     "or 'extension_mm' is what was read at the anchor. Where the distance between two of them is "
     "known, 'to_point' names the other "
     "one and 'distance_mm' says how far it is, the same in every row that states it."},
    {"E-CSV-POSITION",
     "The measured point is missing: columns x_mm, y_mm, z_mm (or another unit of length). Planar "
     "arms may lack an axis; targets need all three. Rows in which the tool touches a fixed point "
     "name it in a column 'point' instead, and so do 'plane', 'sphere' and 'anchor'."},
    {"E-CSV-QUATERNION",
     "The quaternion's length is off by more than 0.001. Often the order is another one (scalar "
     "last) or the decimals were cut. Smaller deviations are normalised."},
    {"E-CSV-QUOTE",
     "A text in quotes ends on its own line, and only a separator may follow. A quote inside is "
     "written twice."},
    {"E-CSV-RAGGED",
     "A row, or every row, has more or fewer cells than the header. A text that holds the "
     "separator stands in "
     "quotes; a decimal comma needs ';' between the columns."},
    {"E-CSV-RANGE",
     "The number is too large or too small to be held: beyond 1e308 or below 1e-308."},
    {"E-CSV-ROTATION",
     "Three angles mean nothing without their convention. If R = Rz(rz) Ry(ry) Rx(rx), turns about "
     "the fixed axes, add the line '# rot: xyz-fixed'. The other orders have names of the same "
     "kind: "
     "in zyx-moving the first column turns about z, the second about the y axis as it is then (A, "
     "B, C of KUKA); and rotation-vector is one turn about the vector by its length."},
    {"E-CSV-ROWS", "There is a header but no row below it. Export the measurements again."},
    {"E-CSV-SEPARATOR",
     "Columns are separated by commas, or by ';' with decimal commas. plumb import converts other "
     "files."},
    {"E-CSV-SET", "The column 'set' holds fit, held or ignore, or nothing."},
    {"E-CSV-SETUP",
     "The cell lists set-ups ([[measurement.setup]]), and every row belongs to one of them: either "
     "the set-up names its file, or the column 'setup' holds the name. Here rows belong to none or "
     "to two, or a set-up has no rows."},
    {"E-CSV-SIGMA",
     "A standard deviation cannot be negative. Give the instrument's 1 sigma, or delete the "
     "columns "
     "and set sigma_um in cell.toml."},
    {"E-CSV-TEXT",
     "The column holds texts, and plumb reads texts only of pose, set, note, time and setup. "
     "Remove it, or give it the name 'note': such a column is passed through and not read. plumb "
     "import leaves such columns out."},
    {"E-CSV-TIME",
     "The column 'time' holds dates and times of ISO 8601, 2026-03-01T12:30:00 for example, with a "
     "zone or without. Give seconds in a column t_s instead if there is no date."},
    {"E-CSV-UNIT",
     "Every numeric column carries its unit in its name: x_mm, q1_deg, temp_degC. Units are mm, m, "
     "um, in, deg, rad, mrad, urad, kg, g, degC, K, s, ms, us, N, Nm. Only pose, repeat, set, "
     "note, "
     "time, status, fold, joint, type, quaternions and dir_jN have none."},
    {"E-CSV-UTF8",
     "The file is not UTF-8. The help line converts it; the encoding is a guess. plumb import "
     "reads "
     "UTF-16 and Latin-1 too."},
    {"E-EXISTS", "Nothing is overwritten unless asked for. Choose another name or add --force."},
    {"E-FORMULA-DOMAIN",
     "A formula of the robot or its environment runs in the cycle, where only joint positions, "
     "loads, directions, travel, payload, temperatures, time and the tip are known. One that reads "
     "uN or row cleans the fit and is then thrown away: domain = \"procedure\" or "
     "\"measurement\"."},
    {"E-FORMULA-LONG",
     "A formula runs in every cycle, so its length is bounded. Split it into several formulas with "
     "the same target: they add up."},
    {"E-FORMULA-NAME",
     "Formulas are told apart by their names, or by their targets if they have none. A name is of "
     "letters, digits and _."},
    {"E-FORMULA-NUMBER",
     "A part of the formula divides by zero or is infinite or undefined at every pose."},
    {"E-FORMULA-PARAMETER",
     "A parameter is declared as \"k [rad/(N m)] ~ 1e-6 = 2e-6\": its name, its unit ([1] if "
     "it has none), its typical size and, if wanted, where the fit begins. Every one must be "
     "used."},
    {"E-FORMULA-SYNTAX",
     "The expression cannot be read. It is made of numbers, variables, parameters, + - * / ^ ( ) "
     "and sin cos exp log sqrt abs tanh sign min max clamp step."},
    {"E-FORMULA-TARGET",
     "A formula moves a joint (dq2), a frame (pre2.rx, post2.dz, base.dx, tool.rz) or the tip "
     "(tcp.x), all in m or rad."},
    {"E-FORMULA-UNIT",
     "Sums, comparisons and the result must have matching units; sin, exp, log and the like want "
     "plain numbers, and rad is one. A number may carry a unit: 50 [N m]; 0 has every unit."},
    {"E-FORMULA-VARIABLE",
     "A formula reads q1 tau1 dir1 travel1 u1 and so on, t, payload, temp_NAME, x y z (the tip in "
     "the base), row, pi and its own parameters. Joints count from 1."},
    {"E-OUTPUT-INPUT",
     "The file to be written is one that the command reads, or one of the cell's own that another "
     "command makes. --force replaces earlier results, never what they were made from. Name "
     "another file."},
    {"E-READ",
     "The file cannot be read; the system's reason is given. Check the path and the "
     "permissions."},
    {"E-READ-SIZE",
     "A file is read whole, up to 2 GB; cell.toml up to 16 MB, a URDF file up to 64 MB, a pipe or "
     "a "
     "device up to 512 MB. What holds more is not what its name says, or never ends."},
    {"E-TOML",
     "cell.toml is not valid TOML at the place shown. Usual causes: a missing quote, a missing "
     "comma in a list, a key given twice."},
    {"E-WRITE",
     "The file cannot be written; the system's reason is given. Nothing was changed: the new text "
     "goes to a temporary file first and replaces the old one only when it is complete on disk."},
    {"N-CELL-LIMITS",
     "Joints without limits are taken to reach ±360° or ±10 m. Limits bound the poses that are "
     "simulated and planned, so give them: q = [min, max]."},
    {"N-CSV-SEMICOLON",
     "The header is separated by ';', so a comma in a number is read as the decimal sign; a point "
     "is "
     "too, and the message says which one the numbers have."},
    {"N-WRITE-FOLDER",
     "The file was to stand in a folder that did not exist. The folder was made; if its name was "
     "mistyped, move the file and remove the folder."},
    {"W-CELL-ANGLE",
     "An angle looks as if it were in another unit: 90 in a file in radians, 1.5708 in a file in "
     "degrees, or joint limits of a few degrees or of many turns. Check angle_unit in [robot]."},
    {"W-CELL-CENTRE",
     "The centre of mass of a link lies far beside the line between its joint and the next one. "
     "com_mm is in the frame that turns with the joint, with its origin ahead of d; data sheets "
     "give it in the Denavit-Hartenberg frame of the link: for those, write com_frame = "
     "\"dh\"."},
    {"W-CELL-GRAVITY",
     "The vector 'gravity' of [robot] is in m/s^2, in the base frame, so its length is 9.81 on "
     "Earth. One of 9810 is in mm/s^2, and every effect of weight would come out a thousand times "
     "too soft. [0, 0, 0] switches gravity off."},
    {"W-CELL-LENGTH", "A link is longer than 20 m. Check length_unit in [robot]."},
    {"W-CELL-MASS",
     "A link or payload of more than 5 tonnes is most often a mass in grams. Masses are in kg."},
    {"W-CELL-PRIOR",
     "Fewer than five arms of this model could be fitted when plumb fleet wrote the file that "
     "[fit] "
     "prior_from names, so nothing typical is known of them. The cell is fitted as without it."},
    {"W-CSV-COLUMN",
     "A column of that name is not known, so nothing reads it; but it differs by a slip from one "
     "that "
     "is. Columns of your own are welcome under any other name."},
    {"W-CSV-DOUBLE",
     "Rows are identical to the last digit. Copied by mistake they count twice and make the noise "
     "look smaller than it is; a true repeat has its own reading."},
    {"W-CSV-LOST",
     "A reading is no point of this arm: exactly (0, 0, 0), which many trackers write for a lost "
     "beam, or farther from the others than the arm and any tool reach, such as -9999. It is left "
     "out as if column set said ignore."},
    {"W-CSV-MIXED",
     "Some files have these columns and others do not, so they are used in none. Complete the "
     "files or delete the columns."},
    {"W-CSV-NAME",
     "Column names are in lower case. This one differs from a known name by its case only and is "
     "kept as a column of your own."},
    {"W-CSV-POINT",
     "A touched point is known only by the rows that touch it. With one row it can be anywhere, "
     "so that the row says nothing about the arm. The same holds for three rows of a plane, and "
     "for "
     "three or, with an unknown radius or zero, four of a sphere or an anchor."},
    {"W-CSV-POSE",
     "Rows of one pose name are repeats of one pose, but these differ by more than 0.02 rad or m. "
     "The noise floor would be far too large: give every pose its own name."},
    {"W-CSV-SETUP",
     "The column 'setup' holds more than one name, but the cell lists no set-ups, so that one "
     "tracker "
     "frame and one target are fitted to all rows. List them: [[measurement.setup]] with the "
     "name."},
    {"W-CSV-SIGMA",
     "No reading is exact: a standard deviation of zero, which some trackers write where they have "
     "none, would give its reading all the weight. The smallest one above zero of the same axis is "
     "taken instead; where all are zero the columns are not used."},
    {"W-CSV-VALUE",
     "The numbers of a column cannot be meant in the unit of its name: a load of tonnes (grams), a "
     "temperature of 290 degC (kelvin) or of 70 degC in the air (Fahrenheit), a move of many "
     "turns. Rename the column to the unit that is meant, or convert the numbers."},
});

}  // namespace

std::span<const CodeHelp> cell_codes() { return kCodes; }

const CodeHelp* find_code(std::string_view code) {
  const auto* found =
      std::find_if(kCodes.begin(), kCodes.end(), [&](const auto& c) { return c.code == code; });
  return found == kCodes.end() ? nullptr : found;
}

}  // namespace plumb::offline
