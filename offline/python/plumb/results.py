# SPDX-License-Identifier: Apache-2.0
# Made from docs/schemas by tests/pages/python_types.py; do not edit.
"""What the verbs of plumb answer."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Literal, Optional, Union

VERSION = "0.1.0"


@dataclass(frozen=True)
class ProblemPlace:
    file: str
    """File."""
    line: int
    """Line, counted from 1; 0: unknown."""
    column: int
    """Column, counted from 1; 0: unknown."""


@dataclass(frozen=True)
class Problem:
    """A message: an error, a warning or a note."""

    severity: Literal["error", "warning", "note"]
    """Error: nothing was written; warning: done, but read this; note: a choice made for you."""
    code: str
    """Stable name of the message, such as E-CSV-UNIT; plumb explain CODE describes it."""
    message: str
    """One sentence."""
    place: Optional[ProblemPlace]
    """Where in a file; null if it belongs to no place of a file."""
    help: str
    """One line that can be pasted; may be empty."""


@dataclass(frozen=True)
class InputFile:
    """A file that went in."""

    file: str
    """File that was read."""
    sha256: str
    """Its check sum."""


@dataclass(frozen=True)
class Statistics:
    """Position errors of one set of readings, or null with a reason where the set is empty."""

    n: int
    """How many readings."""
    mean_mm: Optional[float]
    """Mean 3-D position error [mm]; null with the reason in mean_mm_reason."""
    rms_mm: Optional[float]
    """RMS of the 3-D position error [mm]; null with the reason in rms_mm_reason."""
    p95_mm: Optional[float]
    """Error that 95 % of the readings do not exceed [mm]; null with the reason in p95_mm_reason."""
    max_mm: Optional[float]
    """Largest 3-D position error [mm]; null with the reason in max_mm_reason."""
    mean_mm_reason: Optional[str] = None
    rms_mm_reason: Optional[str] = None
    p95_mm_reason: Optional[str] = None
    max_mm_reason: Optional[str] = None


@dataclass(frozen=True)
class FindingWhy:
    text: str
    """Why it fails, in plain words."""
    state: Literal["certain", "a_or_b", "doubtful", "nothing", "not_looked"]
    """How sure that is: certain; a_or_b: these poses cannot tell two causes apart; doubtful: the cause or its size is in doubt; nothing: nothing is found; not_looked: nobody has diagnosed this run."""


@dataclass(frozen=True)
class Finding:
    class_: Literal["good", "good_but", "limited", "missing", "undecidable", "not_good"]
    """Is it good? good: it keeps the tolerance; good_but: so, with a reservation that the sentence names; limited: it misses it by no more than noise or the scatter of the joints leave; missing: it misses it, and an effect of the library is missing; undecidable: no reading was held out; not_good: it misses it for a reason that is not known yet."""
    sentence: str
    """The same in one sentence, with its figures."""
    where: str
    """Where it fails: the region of the largest errors."""
    why: FindingWhy
    next: str
    """What to do next: the command that helps most."""
    next_why: str
    """What that is for; may be empty."""


@dataclass(frozen=True)
class Add:
    """Result of plumb add: Puts an effect into the model and fits again."""

    effect: str
    """Effect."""
    joints: list[str]
    """Joints."""
    before: Statistics
    """Held-out error before."""
    after: Statistics
    """Held-out error after."""
    run_before: int
    """Number of the run before."""
    finding: Finding
    """What people ask first, the same object in every verb that judges: is it good, where does it fail, why, and what to do next."""
    verdict: str
    """The answer in one sentence."""
    verdict_head: str
    """The same in few words: Good; Not good everywhere; Limited by the measurement."""
    verdict_error: Statistics
    """Held-out error that the verdict rests on: without single readings that stand out."""
    verdict_class: Literal["good", "partly", "bad", "unknown"]
    """good: within tolerance; partly: not everywhere, or something is missing, or the measurement sets the limit; bad; unknown: nothing was held out."""
    run: Optional[int]
    """Number of the run that was kept; null with the reason in run_reason."""
    files: list[str]
    """Files that were written, or would be with --dry-run."""
    dry_run: bool
    """--dry-run was given: nothing was written."""
    figure: Optional[str] = None
    """Of a formula: its curve over what it follows, with what it has to explain, as an SVG file of 440 px."""
    run_reason: Optional[str] = None


@dataclass(frozen=True)
class BenchConditions:
    """The machine."""

    kernel: Optional[str]
    """Kernel; null with the reason in kernel_reason."""
    preempt_rt: bool
    """It is PREEMPT_RT."""
    cpu: Optional[str]
    """Processor; null with the reason in cpu_reason."""
    cpus: int
    """Number of processors."""
    governor: Optional[str]
    """Frequency governor; null with the reason in governor_reason."""
    isolated_cpus: str
    """Isolated processors."""
    sibling_cpus: str
    """Processors that share the core."""
    runs_on_cpus: str
    """Processors that it may run on."""
    virtual_machine: Optional[bool]
    """This is a virtual machine; null with the reason in virtual_machine_reason."""
    load_average_1min: Optional[float]
    """Load of the last minute; null with the reason in load_average_1min_reason."""
    build: str
    """Instruction set of the build."""
    compiler: str
    """Compiler."""
    optimised: bool
    """Optimised build."""
    clock_ns: Optional[float]
    """Cost of reading the clock, taken off every reading [ns]; null with the reason in clock_ns_reason."""
    swept_bytes: int
    """Memory that is swept before a cold call."""
    why_not_representative: list[str]
    """Reasons why the numbers are not representative."""
    kernel_reason: Optional[str] = None
    cpu_reason: Optional[str] = None
    governor_reason: Optional[str] = None
    virtual_machine_reason: Optional[str] = None
    load_average_1min_reason: Optional[str] = None
    clock_ns_reason: Optional[str] = None


@dataclass(frozen=True)
class BenchKernels:
    name: str
    """Part of the cycle."""
    way: Literal["warm", "latency_chain", "cold"]
    """How it was called: with warm caches, each call needing the result of the last, or with cold caches."""
    ns_median: Optional[float]
    """Median of a call [ns]; null with the reason in ns_median_reason."""
    ns_p99: Optional[float]
    """Time that 99 % of the calls do not exceed [ns]; null with the reason in ns_p99_reason."""
    ns_max: Optional[float]
    """Longest call [ns]; null with the reason in ns_max_reason."""
    calls: int
    """Calls."""
    calls_per_reading: int
    """Calls between two readings of the clock."""
    ns_median_reason: Optional[str] = None
    ns_p99_reason: Optional[str] = None
    ns_max_reason: Optional[str] = None
    ns_median_added: Optional[float] = None
    """What it adds to the median [ns]; null with the reason in ns_median_added_reason."""
    ns_median_added_reason: Optional[str] = None


@dataclass(frozen=True)
class Bench:
    """Result of plumb bench: How long a cycle takes."""

    ns_median: Optional[float]
    """Median of a call [ns]; null with the reason in ns_median_reason."""
    ns_p99: Optional[float]
    """Time that 99 % of the calls do not exceed [ns]; null with the reason in ns_p99_reason."""
    ns_max: Optional[float]
    """Longest call [ns]; null with the reason in ns_max_reason."""
    calls: int
    """Calls."""
    allocations: int
    """Heap calls in the cycle."""
    instructions: float
    """Instructions of a step at worst, by a sum over the parts of the model, counted for x86-64-v3."""
    instructions_baseline: float
    """The same in the build for every x86-64 processor, in part estimated."""
    representative: bool
    """The numbers tell of a machine in production."""
    conditions: BenchConditions
    """The machine."""
    cycle_us: float
    """Cycle of the model [us]."""
    share_of_cycle_pct: float
    """Share of it that the median takes [%]."""
    seed: int
    """Seed of the poses."""
    poses: int
    """Random poses."""
    refused_poses: int
    """Poses that were refused."""
    kernels: list[BenchKernels]
    """Parts of the cycle."""
    ns_median_reason: Optional[str] = None
    ns_p99_reason: Optional[str] = None
    ns_max_reason: Optional[str] = None
    files: Optional[list[str]] = None
    """Files that were written, or would be with --dry-run."""
    dry_run: Optional[bool] = None
    """--dry-run was given: nothing was written."""


@dataclass(frozen=True)
class Blocks:
    kind: Literal["sentence", "note", "table", "figure", "action"]
    """What it is: a sentence that says what was found, a note beside it, a table, a figure of plumb plot, or a command to type next."""
    words: Optional[str] = None
    """Of a sentence or a note."""
    class_: Optional[Literal["good", "partly", "bad", "unknown", ""]] = None
    """Of a sentence that judges: its colour; else empty."""
    name: Optional[str] = None
    """Of a table or a figure."""
    caption: Optional[str] = None
    """Of a table."""
    head: Optional[list[str]] = None
    """Of a table: what stands in each column."""
    rows: Optional[list[list[str]]] = None
    """Of a table: words and numbers as they are shown."""
    command: Optional[str] = None
    """Of an action."""
    why: Optional[str] = None
    """Of an action: what it is for; may be empty."""


@dataclass(frozen=True)
class CheckConventionPresentTurnedZeros:
    joint: int
    """Joint, from 1."""
    angle_deg: float
    """Turn of its zero [deg]."""


@dataclass(frozen=True)
class CheckConventionPresentCoupling:
    joint: int
    """Joint, from 1."""
    by: int
    """The joint that is added, from 1."""
    ratio: float
    """Ratio."""


@dataclass(frozen=True)
class CheckConventionPresentJointOffsets:
    joint: int
    """Joint, from 1."""
    offset_deg: float
    """What is added to the joint's position [deg]."""


@dataclass(frozen=True)
class CheckConventionPresentJointFactors:
    joint: int
    """Joint, from 1."""
    factor: float
    """By what."""


@dataclass(frozen=True)
class CheckConventionPresentJointUnits:
    joint: int
    """Joint, from 1."""
    unit: str
    """The unit it is in."""


@dataclass(frozen=True)
class CheckConventionPresent:
    """The files as they are labelled."""

    dh_convention: Literal["standard", "modified"]
    """Convention of the DH rows."""
    length_unit: str
    """Unit of lengths in cell.toml."""
    angle_unit: str
    """Unit of angles in cell.toml."""
    joint_angle_unit: str
    """Unit of the readings of joints that turn."""
    sliding_joint_unit: str
    """Unit of the readings of joints that slide."""
    point_unit: str
    """Unit of the measured points."""
    reversed_joints: list[int]
    """Joints that count the other way, from 1."""
    joint_columns: list[int]
    """Of each joint, the number of the column q that holds its values: 1, 2, ... in the order of the arm."""
    turned_zeros: list[CheckConventionPresentTurnedZeros]
    """Joints whose zero lies elsewhere."""
    coupling: list[CheckConventionPresentCoupling]
    """The controller's coupling of joints: the angle of the joint is its value plus ratio times that of the other."""
    joint_offsets: list[CheckConventionPresentJointOffsets]
    """Joints whose zero is not that of the DH table, by no quarter turn."""
    joint_factors: list[CheckConventionPresentJointFactors]
    """Joints whose readings are multiplied."""
    joint_units: list[CheckConventionPresentJointUnits]
    """Joints whose column alone is in another unit."""
    left_handed: bool
    """An axis of the measurement frame is mirrored."""
    frame_inverted: bool
    """The given frame is the inverse of what it should be."""
    changes: Optional[list[str]] = None
    """What differs from the labels, in words."""
    placed_rms_mm: Optional[float] = None
    """RMS with frame and target fitted only [mm]; null with the reason in placed_rms_mm_reason."""
    placed_rms_mm_reason: Optional[str] = None
    residual_mm: Optional[float] = None
    """RMS with the geometry fitted too [mm]; null with the reason in residual_mm_reason."""
    residual_mm_reason: Optional[str] = None


@dataclass(frozen=True)
class CheckConventionBestTurnedZeros:
    joint: int
    """Joint, from 1."""
    angle_deg: float
    """Turn of its zero [deg]."""


@dataclass(frozen=True)
class CheckConventionBestCoupling:
    joint: int
    """Joint, from 1."""
    by: int
    """The joint that is added, from 1."""
    ratio: float
    """Ratio."""


@dataclass(frozen=True)
class CheckConventionBestJointOffsets:
    joint: int
    """Joint, from 1."""
    offset_deg: float
    """What is added to the joint's position [deg]."""


@dataclass(frozen=True)
class CheckConventionBestJointFactors:
    joint: int
    """Joint, from 1."""
    factor: float
    """By what."""


@dataclass(frozen=True)
class CheckConventionBestJointUnits:
    joint: int
    """Joint, from 1."""
    unit: str
    """The unit it is in."""


@dataclass(frozen=True)
class CheckConventionBest:
    """The reading that fits best."""

    dh_convention: Literal["standard", "modified"]
    """Convention of the DH rows."""
    length_unit: str
    """Unit of lengths in cell.toml."""
    angle_unit: str
    """Unit of angles in cell.toml."""
    joint_angle_unit: str
    """Unit of the readings of joints that turn."""
    sliding_joint_unit: str
    """Unit of the readings of joints that slide."""
    point_unit: str
    """Unit of the measured points."""
    reversed_joints: list[int]
    """Joints that count the other way, from 1."""
    joint_columns: list[int]
    """Of each joint, the number of the column q that holds its values: 1, 2, ... in the order of the arm."""
    turned_zeros: list[CheckConventionBestTurnedZeros]
    """Joints whose zero lies elsewhere."""
    coupling: list[CheckConventionBestCoupling]
    """The controller's coupling of joints: the angle of the joint is its value plus ratio times that of the other."""
    joint_offsets: list[CheckConventionBestJointOffsets]
    """Joints whose zero is not that of the DH table, by no quarter turn."""
    joint_factors: list[CheckConventionBestJointFactors]
    """Joints whose readings are multiplied."""
    joint_units: list[CheckConventionBestJointUnits]
    """Joints whose column alone is in another unit."""
    left_handed: bool
    """An axis of the measurement frame is mirrored."""
    frame_inverted: bool
    """The given frame is the inverse of what it should be."""
    changes: Optional[list[str]] = None
    """What differs from the labels, in words."""
    placed_rms_mm: Optional[float] = None
    """RMS with frame and target fitted only [mm]; null with the reason in placed_rms_mm_reason."""
    placed_rms_mm_reason: Optional[str] = None
    residual_mm: Optional[float] = None
    """RMS with the geometry fitted too [mm]; null with the reason in residual_mm_reason."""
    residual_mm_reason: Optional[str] = None


@dataclass(frozen=True)
class CheckConventionTableTurnedZeros:
    joint: int
    """Joint, from 1."""
    angle_deg: float
    """Turn of its zero [deg]."""


@dataclass(frozen=True)
class CheckConventionTableCoupling:
    joint: int
    """Joint, from 1."""
    by: int
    """The joint that is added, from 1."""
    ratio: float
    """Ratio."""


@dataclass(frozen=True)
class CheckConventionTableJointOffsets:
    joint: int
    """Joint, from 1."""
    offset_deg: float
    """What is added to the joint's position [deg]."""


@dataclass(frozen=True)
class CheckConventionTableJointFactors:
    joint: int
    """Joint, from 1."""
    factor: float
    """By what."""


@dataclass(frozen=True)
class CheckConventionTableJointUnits:
    joint: int
    """Joint, from 1."""
    unit: str
    """The unit it is in."""


@dataclass(frozen=True)
class CheckConventionTable:
    dh_convention: Literal["standard", "modified"]
    """Convention of the DH rows."""
    length_unit: str
    """Unit of lengths in cell.toml."""
    angle_unit: str
    """Unit of angles in cell.toml."""
    joint_angle_unit: str
    """Unit of the readings of joints that turn."""
    sliding_joint_unit: str
    """Unit of the readings of joints that slide."""
    point_unit: str
    """Unit of the measured points."""
    reversed_joints: list[int]
    """Joints that count the other way, from 1."""
    joint_columns: list[int]
    """Of each joint, the number of the column q that holds its values: 1, 2, ... in the order of the arm."""
    turned_zeros: list[CheckConventionTableTurnedZeros]
    """Joints whose zero lies elsewhere."""
    coupling: list[CheckConventionTableCoupling]
    """The controller's coupling of joints: the angle of the joint is its value plus ratio times that of the other."""
    joint_offsets: list[CheckConventionTableJointOffsets]
    """Joints whose zero is not that of the DH table, by no quarter turn."""
    joint_factors: list[CheckConventionTableJointFactors]
    """Joints whose readings are multiplied."""
    joint_units: list[CheckConventionTableJointUnits]
    """Joints whose column alone is in another unit."""
    left_handed: bool
    """An axis of the measurement frame is mirrored."""
    frame_inverted: bool
    """The given frame is the inverse of what it should be."""
    changes: Optional[list[str]] = None
    """What differs from the labels, in words."""
    placed_rms_mm: Optional[float] = None
    """RMS with frame and target fitted only [mm]; null with the reason in placed_rms_mm_reason."""
    placed_rms_mm_reason: Optional[str] = None
    residual_mm: Optional[float] = None
    """RMS with the geometry fitted too [mm]; null with the reason in residual_mm_reason."""
    residual_mm_reason: Optional[str] = None


@dataclass(frozen=True)
class CheckConvention:
    """How units and conventions are meant."""

    changed: bool
    """Another reading of the labels fits better."""
    tried: int
    """Readings that were tried."""
    residual_mm: Optional[float]
    """RMS of the best reading [mm]; null with the reason in residual_mm_reason."""
    present: CheckConventionPresent
    """The files as they are labelled."""
    best: CheckConventionBest
    """The reading that fits best."""
    table: list[CheckConventionTable]
    """The best readings, best first."""
    residual_mm_reason: Optional[str] = None
    same_points: Optional[list[list[str]]] = None
    """Readings that give the same points, in words."""


@dataclass(frozen=True)
class CheckIdentifiabilityObservability:
    """Observability indices of the poses."""

    O1: Optional[float]
    """Observability index O1; null with the reason in O1_reason."""
    O2: Optional[float]
    """Observability index O2; null with the reason in O2_reason."""
    O3: Optional[float]
    """Observability index O3; null with the reason in O3_reason."""
    O4: Optional[float]
    """Observability index O4; null with the reason in O4_reason."""
    O5: Optional[float]
    """Observability index O5; null with the reason in O5_reason."""
    O1_reason: Optional[str] = None
    O2_reason: Optional[str] = None
    O3_reason: Optional[str] = None
    O4_reason: Optional[str] = None
    O5_reason: Optional[str] = None


@dataclass(frozen=True)
class CheckIdentifiabilityCorrelations:
    parameter: str
    """Parameter."""
    with_: list[str]
    """Parameters it cannot be told from."""
    rho: float
    """Correlation."""
    cause: Literal["choice", "arm", "poses", "weak"]
    """Why: a choice of frames, the arm, the poses, or little effect on the measured point."""
    text: str
    """The same in words."""


@dataclass(frozen=True)
class CheckIdentifiability:
    rank: int
    """Numbers that these poses identify."""
    candidates: int
    """Numbers of the geometry."""
    fitted: int
    """Numbers that would be fitted."""
    scaled_condition: Optional[float]
    """Condition number of the Jacobian of the fitted parameters, columns of unit length; null with the reason in scaled_condition_reason."""
    calibrability: Optional[float]
    """Condition number of J^T J of the fitted parameters, columns in SI units; null with the reason in calibrability_reason."""
    observability: CheckIdentifiabilityObservability
    """Observability indices of the poses."""
    correlations: list[CheckIdentifiabilityCorrelations]
    """Parameters that cannot be told apart."""
    scaled_condition_reason: Optional[str] = None
    calibrability_reason: Optional[str] = None


@dataclass(frozen=True)
class CheckCoverage:
    joint: str
    """Joint."""
    share: float
    """Share of the joint limits that the poses use, 0 to 1."""
    histogram: list[int]
    """Poses in each tenth of the used range."""
    text: str
    """The same in words."""
    min_deg: Optional[float] = None
    """Lowest reading [deg]."""
    max_deg: Optional[float] = None
    """Highest reading [deg]."""
    limit_min_deg: Optional[float] = None
    """Lower joint limit [deg]."""
    limit_max_deg: Optional[float] = None
    """Upper joint limit [deg]."""
    min_mm: Optional[float] = None
    """Lowest reading [mm]."""
    max_mm: Optional[float] = None
    """Highest reading [mm]."""
    limit_min_mm: Optional[float] = None
    """Lower joint limit [mm]."""
    limit_max_mm: Optional[float] = None
    """Upper joint limit [mm]."""


@dataclass(frozen=True)
class CheckBox:
    """Box around the measured points, in the base frame."""

    min_mm: list[float]
    """Lower corner [mm]."""
    max_mm: list[float]
    """Upper corner [mm]."""


@dataclass(frozen=True)
class CheckRounding:
    step: float
    """Step of the joint readings, in its unit."""
    unit: str
    """Unit."""
    at_tool_rms_mm: float
    """What it makes at the tool, RMS [mm]."""


@dataclass(frozen=True)
class Orientation:
    kind: Literal["unjudged", "good", "scattered", "missed", "otherwise", "turned", "constant", "nominal", "contradict", "unexplained"]
    """What they are: as stated (good), of more scatter (scattered), missed by the model though repeats agree (missed), meant otherwise (otherwise), in another frame (turned), the same in all rows (constant), those of the nominal arm (nominal), at odds with the points (contradict), unexplained, or not judged because the points alone do not give the arm (unjudged)."""
    used: bool
    """They are fitted."""
    meant: list[str]
    """The readings of the columns that fit, in words; the fit does not look for them."""
    text: str
    """What they are, in words; empty if nothing is wrong."""
    as_labelled_urad: Optional[float]
    """Usual error per axis as labelled, about the arm that the points give [urad]."""
    scatter_urad: Optional[float]
    """The same as they are meant, about an arm that fits both [urad]."""
    as_labelled_urad_reason: Optional[str] = None
    scatter_urad_reason: Optional[str] = None


@dataclass(frozen=True)
class NoiseFloor:
    measured_mm: Optional[float]
    """Mean 3-D error that the noise of the readings alone makes, as repeats show it or sigma_um states it [mm]; null with the reason in measured_mm_reason."""
    inferred_mm: Optional[float]
    """What the scatter of the joints would make it, which a diagnosis inferred and nobody measured [mm]; null with the reason in inferred_mm_reason."""
    source: Literal["repeats", "sigma", "none"]
    """Where measured_mm is from."""
    measured_mm_reason: Optional[str] = None
    inferred_mm_reason: Optional[str] = None


@dataclass(frozen=True)
class CheckEffects:
    effect: str
    """Effect."""
    testable: Literal["no", "weakly", "yes"]
    """Whether these data can show it."""
    why: str
    """Why."""
    measure: str
    """What to measure so that they can."""


@dataclass(frozen=True)
class Check:
    """Result of plumb check: Judges the files of a cell: units, conventions, coverage, and what the data can show."""

    blocks: list[Blocks]
    """The result as it is shown, block by block."""
    ok: bool
    """Nothing is wrong that stops a fit."""
    verdict: str
    """The answer in one sentence."""
    findings: list[Problem]
    """What was found."""
    convention: CheckConvention
    """How units and conventions are meant."""
    identifiability: Optional[CheckIdentifiability]
    """What these poses can identify; null with the reason in identifiability_reason."""
    coverage: list[CheckCoverage]
    """What the poses cover of each joint."""
    rounding: Optional[CheckRounding]
    """Rounding of the joint readings; null with the reason in rounding_reason."""
    noise_floor: NoiseFloor
    """The noise floor: what was measured apart from what is only inferred."""
    noise_floor_mm: Optional[float]
    """Mean 3-D error that the noise of the readings alone makes [mm]; null with the reason in noise_floor_mm_reason."""
    noise_floor_rms_mm: Optional[float]
    """RMS of the 3-D error that the noise alone makes [mm]; null with the reason in noise_floor_rms_mm_reason."""
    effects: list[CheckEffects]
    """Which effects these data can show."""
    identifiability_reason: Optional[str] = None
    poses: Optional[int] = None
    """Distinct poses."""
    readings: Optional[int] = None
    """Readings."""
    box: Optional[CheckBox] = None
    """Box around the measured points, in the base frame."""
    rounding_reason: Optional[str] = None
    orientation: Optional[Orientation] = None
    """What the measured orientations are; missing if there are none."""
    noise_floor_mm_reason: Optional[str] = None
    noise_floor_rms_mm_reason: Optional[str] = None
    noise_floor_source: Optional[Literal["repeats", "sigma"]] = None
    """Where it is known from: repeats of poses, or sigma_um of the cell."""
    files: Optional[list[str]] = None
    """Files that were written, or would be with --dry-run."""
    dry_run: Optional[bool] = None
    """--dry-run was given: nothing was written."""


@dataclass(frozen=True)
class CompareWorst:
    pose: str
    """Pose."""
    row: int
    """Row of the measurements, from 1."""
    error_mm: float
    """Its 3-D error [mm]."""
    dx_mm: float
    """X component of the error [mm]."""
    dy_mm: float
    """Y component of the error [mm]."""
    dz_mm: float
    """Z component of the error [mm]."""
    set: Literal["held", "fit"]
    """Which set it belongs to."""


@dataclass(frozen=True)
class CompareByJoint:
    joint: str
    """Joint."""
    n: int
    """Held-out readings in it."""
    mean_mm: Optional[float]
    """Mean error of the held-out readings in it [mm]; null with the reason in mean_mm_reason."""
    n_fit: int
    """Fitted readings in it."""
    mean_fit_mm: Optional[float]
    """Mean error of the fitted readings in it [mm]; null with the reason in mean_fit_mm_reason."""
    mean_mm_reason: Optional[str] = None
    mean_fit_mm_reason: Optional[str] = None
    more: dict[str, Any] = field(default_factory=dict)
    """Members whose names depend on the cell."""


@dataclass(frozen=True)
class CompareByRegion:
    quantity: str
    """What the bins are of."""
    n: int
    """Held-out readings in it."""
    mean_mm: Optional[float]
    """Mean error of the held-out readings in it [mm]; null with the reason in mean_mm_reason."""
    n_fit: int
    """Fitted readings in it."""
    mean_fit_mm: Optional[float]
    """Mean error of the fitted readings in it [mm]; null with the reason in mean_fit_mm_reason."""
    mean_mm_reason: Optional[str] = None
    mean_fit_mm_reason: Optional[str] = None
    more: dict[str, Any] = field(default_factory=dict)
    """Members whose names depend on the cell."""


@dataclass(frozen=True)
class CompareByLoad:
    quantity: str
    """What the bins are of."""
    n: int
    """Held-out readings in it."""
    mean_mm: Optional[float]
    """Mean error of the held-out readings in it [mm]; null with the reason in mean_mm_reason."""
    n_fit: int
    """Fitted readings in it."""
    mean_fit_mm: Optional[float]
    """Mean error of the fitted readings in it [mm]; null with the reason in mean_fit_mm_reason."""
    mean_mm_reason: Optional[str] = None
    mean_fit_mm_reason: Optional[str] = None
    more: dict[str, Any] = field(default_factory=dict)
    """Members whose names depend on the cell."""


@dataclass(frozen=True)
class CompareByContext:
    quantity: str
    """What the bins are of."""
    n: int
    """Held-out readings in it."""
    mean_mm: Optional[float]
    """Mean error of the held-out readings in it [mm]; null with the reason in mean_mm_reason."""
    n_fit: int
    """Fitted readings in it."""
    mean_fit_mm: Optional[float]
    """Mean error of the fitted readings in it [mm]; null with the reason in mean_fit_mm_reason."""
    mean_mm_reason: Optional[str] = None
    mean_fit_mm_reason: Optional[str] = None
    more: dict[str, Any] = field(default_factory=dict)
    """Members whose names depend on the cell."""


@dataclass(frozen=True)
class CompareByOrder:
    n: int
    """Held-out readings in it."""
    mean_mm: Optional[float]
    """Mean error of the held-out readings in it [mm]; null with the reason in mean_mm_reason."""
    n_fit: int
    """Fitted readings in it."""
    mean_fit_mm: Optional[float]
    """Mean error of the fitted readings in it [mm]; null with the reason in mean_fit_mm_reason."""
    mean_mm_reason: Optional[str] = None
    mean_fit_mm_reason: Optional[str] = None
    more: dict[str, Any] = field(default_factory=dict)
    """Members whose names depend on the cell."""


@dataclass(frozen=True)
class CompareBySetup:
    setup: str
    """Set-up."""
    n: int
    """Held-out readings in it."""
    mean_mm: Optional[float]
    """Mean error of the held-out readings in it [mm]; null with the reason in mean_mm_reason."""
    n_fit: int
    """Fitted readings in it."""
    mean_fit_mm: Optional[float]
    """Mean error of the fitted readings in it [mm]; null with the reason in mean_fit_mm_reason."""
    mean_mm_reason: Optional[str] = None
    mean_fit_mm_reason: Optional[str] = None


@dataclass(frozen=True)
class CompareBy:
    """Mean error in bins of each quantity."""

    joint: list[CompareByJoint]
    """By joint value."""
    region: list[CompareByRegion]
    """By place in the workspace."""
    load: list[CompareByLoad]
    """By load."""
    context: list[CompareByContext]
    """By temperature, payload, time."""
    order: list[CompareByOrder]
    """By order of measurement."""
    setup: Optional[list[CompareBySetup]] = None
    """By set-up, if there are several."""


@dataclass(frozen=True)
class CompareMatters:
    by: Literal["joint", "order", "region", "load", "context", "setup"]
    """Kind of quantity."""
    quantity: str
    """Quantity."""
    explained_pct: float
    """Share of the differences that it explains [%]."""
    ln_p: float
    """Natural logarithm of the probability of that by chance."""
    matters: bool
    """It is beyond chance."""


@dataclass(frozen=True)
class OrientationError:
    """Error of measured orientations."""

    n: int
    """How many readings."""
    mean_deg: Optional[float]
    """Mean of the orientation error [deg]; null with the reason in mean_deg_reason."""
    rms_deg: Optional[float]
    """RMS of the orientation error [deg]; null with the reason in rms_deg_reason."""
    p95_deg: Optional[float]
    """95 % of the orientation error [deg]; null with the reason in p95_deg_reason."""
    max_deg: Optional[float]
    """Largest of the orientation error [deg]; null with the reason in max_deg_reason."""
    noise_floor_deg: Optional[float]
    """Mean orientation error that the noise of the readings alone makes [deg]; null with the reason in noise_floor_deg_reason."""
    mean_deg_reason: Optional[str] = None
    rms_deg_reason: Optional[str] = None
    p95_deg_reason: Optional[str] = None
    max_deg_reason: Optional[str] = None
    noise_floor_deg_reason: Optional[str] = None


@dataclass(frozen=True)
class CompareOrientationErrorsWorst:
    pose: str
    """Pose."""
    row: int
    """Row of the measurements, from 1."""
    error_deg: float
    """Orientation error [deg]."""


@dataclass(frozen=True)
class CompareOrientationErrorsJoints:
    joint: str
    """Joint."""
    share_pct: float
    """Share of the squared error that an error of this joint would explain [%]."""
    rms_urad: float
    """RMS of that error of the joint [urad]."""
    bins: int
    """Bins of its angle."""
    ln_p: float
    """Natural logarithm of the probability of that by chance."""
    matters: bool
    """It is beyond chance."""


@dataclass(frozen=True)
class CompareOrientationErrorsMatters:
    by: Literal["joint", "order", "region", "load", "context", "setup"]
    """Kind of quantity."""
    quantity: str
    """Quantity."""
    explained_pct: float
    """Share of the differences that it explains [%]."""
    ln_p: float
    """Natural logarithm of the probability of that by chance."""
    matters: bool
    """It is beyond chance."""


@dataclass(frozen=True)
class CompareOrientationErrors:
    """Where orientations fail; only if they are fitted."""

    text: str
    """What the orientation error changes with most; empty if nothing beyond chance."""
    joints_text: str
    """Which joint the orientation errors look like; empty if none."""
    worst: list[CompareOrientationErrorsWorst]
    """Orientations that are missed most."""
    joints: list[CompareOrientationErrorsJoints]
    """Which joints the orientation error looks like."""
    matters: list[CompareOrientationErrorsMatters]
    """Which quantities the orientation error changes with."""


@dataclass(frozen=True)
class CompareJoints:
    joint: str
    """Joint."""
    share_pct: float
    """Share of the squared error that an error of this joint would explain [%]."""
    rms_urad: float
    """RMS of that error of the joint [urad]."""
    bins: int
    """Bins of its angle."""
    ln_p: float
    """Natural logarithm of the probability of that by chance."""
    matters: bool
    """It is beyond chance."""


@dataclass(frozen=True)
class CompareLackOfFit:
    """What a better model could remove."""

    text: str
    """In words."""
    ratio: Optional[float]
    """Mean square of what the model misses over that of the noise; null with the reason in ratio_reason."""
    basis: Optional[Literal["repeats", "sigma"]] = None
    """What the noise is known from."""
    ratio_reason: Optional[str] = None
    dof_model: Optional[int] = None
    """Coordinates of distinct poses less the number of parameters."""
    dof_noise: Optional[int] = None
    """Degrees of freedom of the repeats; 0: sigma_um is stated."""
    ln_p: Optional[float] = None
    """Natural logarithm of the probability of that by chance."""
    significant: Optional[bool] = None
    """It is beyond chance."""
    systematic_pct: Optional[float] = None
    """Share of the mean square of a reading that is not noise, so that a better model can remove it [%]."""


@dataclass(frozen=True)
class CompareAutocorrelation:
    """Dependence on the order of measurement."""

    text: str
    """In words."""
    n: int
    """Readings."""
    lag1: Optional[float]
    """Autocorrelation of neighbours in time; null with the reason in lag1_reason."""
    lag1_reason: Optional[str] = None
    low95: Optional[float] = None
    """Lower end of what chance makes."""
    high95: Optional[float] = None
    """Upper end of what chance makes."""
    beyond: Optional[bool] = None
    """It is beyond chance."""
    closeness: Optional[float] = None
    """Distance of successive poses in joint space over that of any two poses."""


@dataclass(frozen=True)
class CompareChangePoints:
    text: str
    """In words."""
    after_row: int
    """Last row before the jump, from 1."""
    after_pose: str
    """Pose before the jump."""
    before_pose: str
    """Pose after the jump."""
    earliest_row: int
    """Earliest row that it may stand at."""
    latest_row: int
    """Latest row that it may stand at."""
    of: Literal["tool", "base", "joint"]
    """What moved."""
    size_mm: float
    """Size at the measured point [mm]."""
    ln_p: float
    """Natural logarithm of the probability of that by chance."""
    joint: Optional[str] = None
    """Joint."""
    shift_mm: Optional[list[float]] = None
    """Displacement [mm]."""
    shift_um: Optional[float] = None
    """Displacement of a sliding joint [um]."""
    turn_urad: Optional[Union[float, list[float]]] = None
    """Rotation: of a joint one number, of the base three [urad]."""


@dataclass(frozen=True)
class CompareDrifts:
    text: str
    """In words."""
    from_row: int
    """First row of the change, from 1."""
    to_row: int
    """Last row of the change."""
    of: Literal["tool", "base", "joint"]
    """What moved."""
    size_mm: float
    """Size at the measured point [mm]."""
    ln_p: float
    """Natural logarithm of the probability of that by chance."""
    joint: Optional[str] = None
    """Joint."""


@dataclass(frozen=True)
class RunRecheck:
    """Only of a run that plumb recheck made."""

    parent_run: int
    """The run that was rechecked."""
    verdict: Literal["true", "changed", "undecidable"]
    """true, changed or undecidable."""
    verdict_text: str
    """The same in words."""
    before: Statistics
    """Error of that run at the new readings."""
    expected_mean_mm: float
    """Mean error that was to be expected there [mm]."""
    control_limit_mm: float
    """Three standard deviations of that mean above it [mm]."""


@dataclass(frozen=True)
class Run:
    """One run in the history."""

    run: int
    """Number of the run."""
    created: str
    """Date and time, ISO 8601."""
    effects: list[str]
    """Effects of its model."""
    base: Literal["arm", "controller"]
    """What was calibrated: the nominal arm, or the positions of the controller."""
    current: bool
    """Made of the present cell and measurements."""
    held_out: Statistics
    """Error of held-out readings."""
    verdict_error: Statistics
    """Held-out error that the verdict rests on: without single readings that stand out."""
    fit: Statistics
    """Error of the fitted readings."""
    cell_sha256: str
    """Check sum of its cell.toml."""
    recheck: Optional[RunRecheck] = None
    """Only of a run that plumb recheck made."""


@dataclass(frozen=True)
class Compare:
    """Result of plumb compare: Holds the model against the measurements."""

    blocks: list[Blocks]
    """The result as it is shown, block by block."""
    n: int
    """How many readings."""
    mean_mm: Optional[float]
    """Mean 3-D position error [mm]; null with the reason in mean_mm_reason."""
    rms_mm: Optional[float]
    """RMS of the 3-D position error [mm]; null with the reason in rms_mm_reason."""
    p95_mm: Optional[float]
    """Error that 95 % of the readings do not exceed [mm]; null with the reason in p95_mm_reason."""
    max_mm: Optional[float]
    """Largest 3-D position error [mm]; null with the reason in max_mm_reason."""
    mean_se_mm: Optional[float]
    """Standard error of the mean, poses counted once [mm]; null with the reason in mean_se_mm_reason."""
    mean_low_mm: Optional[float]
    """Lower end of the 95 % interval of the mean [mm]; null with the reason in mean_low_mm_reason."""
    mean_high_mm: Optional[float]
    """Upper end of the 95 % interval of the mean [mm]; null with the reason in mean_high_mm_reason."""
    set: Literal["held_out", "fit"]
    """Which readings the figures are of."""
    frame: Literal["measurement"]
    """Frame of the errors."""
    run: int
    """Number of the run."""
    fit: Statistics
    """Error of the fitted readings."""
    fit_within_tolerance_pct: float
    """Fitted readings within the tolerance [%]."""
    nominal: Statistics
    """Held-out error before the calibration."""
    noise_floor: NoiseFloor
    """The noise floor: what was measured apart from what is only inferred."""
    noise_floor_mm: Optional[float]
    """Mean 3-D error that the noise of the readings alone makes [mm]; null with the reason in noise_floor_mm_reason."""
    noise_floor_rms_mm: Optional[float]
    """RMS of the 3-D error that the noise alone makes [mm]; null with the reason in noise_floor_rms_mm_reason."""
    tolerance_mm: float
    """Tolerance of the cell [mm]."""
    within_tolerance_pct: float
    """Readings within the tolerance [%]."""
    finding: Finding
    """What people ask first, the same object in every verb that judges: is it good, where does it fail, why, and what to do next."""
    verdict: str
    """The answer in one sentence."""
    verdict_head: str
    """The same in few words: Good; Not good everywhere; Limited by the measurement."""
    verdict_error: Statistics
    """Held-out error that the verdict rests on: without single readings that stand out."""
    verdict_class: Literal["good", "partly", "bad", "unknown"]
    """good: within tolerance; partly: not everywhere, or something is missing, or the measurement sets the limit; bad; unknown: nothing was held out."""
    worst: list[CompareWorst]
    """The ten worst readings."""
    where: str
    """Where it fails, in words: as in finding."""
    by: CompareBy
    """Mean error in bins of each quantity."""
    matters: list[CompareMatters]
    """Which quantities the error changes with."""
    joints: list[CompareJoints]
    """Which joints the error looks like."""
    joints_text: str
    """The same in words."""
    lack_of_fit: CompareLackOfFit
    """What a better model could remove."""
    autocorrelation: CompareAutocorrelation
    """Dependence on the order of measurement."""
    change_points: list[CompareChangePoints]
    """Jumps."""
    drifts: list[CompareDrifts]
    """Slow changes."""
    mean_mm_reason: Optional[str] = None
    rms_mm_reason: Optional[str] = None
    p95_mm_reason: Optional[str] = None
    max_mm_reason: Optional[str] = None
    mean_se_mm_reason: Optional[str] = None
    mean_low_mm_reason: Optional[str] = None
    mean_high_mm_reason: Optional[str] = None
    noise_floor_mm_reason: Optional[str] = None
    noise_floor_rms_mm_reason: Optional[str] = None
    noise_floor_source: Optional[Literal["repeats", "sigma"]] = None
    """Where it is known from: repeats of poses, or sigma_um of the cell."""
    inferred_floor_mm: Optional[float] = None
    """Mean 3-D error that the scatter of the joints would make, which a diagnosis inferred from what the model leaves; not measured [mm]."""
    held_out_orientation: Optional[OrientationError] = None
    """Orientation error of held-out readings; null with the reason in held_out_orientation_reason."""
    held_out_orientation_reason: Optional[str] = None
    orientation_errors: Optional[CompareOrientationErrors] = None
    """Where orientations fail; only if they are fitted."""
    runs: Optional[list[Run]] = None
    """The runs that were named, if several were."""


@dataclass(frozen=True)
class AuditRefusedWhere:
    joint: str
    """Name of the joint."""
    pct: float
    """Share of all poses that is refused there [%]."""
    at_deg: Optional[float] = None
    """Its position, modulo half a turn [deg]."""
    within_deg: Optional[float] = None
    """How far to either side [deg]."""
    at_mm: Optional[float] = None
    """Position of a prismatic joint [mm]."""
    within_mm: Optional[float] = None
    """How far to either side [mm]."""


@dataclass(frozen=True)
class Audit:
    """What an audit of the model found."""

    worst_correction_mm: Optional[float]
    """Largest correction at the tool [mm]; null with the reason in worst_correction_mm_reason."""
    worst_rotation_deg: Optional[float]
    """Largest correction of the orientation [deg]; null with the reason in worst_rotation_deg_reason."""
    worst_at: dict[str, Any]
    """Joint values where it is that large."""
    max_correction_mm: Optional[float]
    """Limit of the guard [mm]; null with the reason in max_correction_mm_reason."""
    worst_leaf_jump_mm: Optional[float]
    """Largest step at a border of two leaves of the tree [mm]; null with the reason in worst_leaf_jump_mm_reason."""
    sigma_tool_mean_mm: Optional[float]
    """1 sigma of the fitted numbers alone at the tool, mean [mm]; null with the reason in sigma_tool_mean_mm_reason."""
    sigma_tool_max_mm: Optional[float]
    """1 sigma of the fitted numbers alone at the tool, largest [mm]; null with the reason in sigma_tool_max_mm_reason."""
    sigma_beside_mm: Optional[float]
    """What the uncertain orientation of the tool adds to that at a point 100 mm beside it, on average [mm]; angles of the last link that no position shows count with 0.5 mrad. null with the reason in sigma_beside_mm_reason."""
    leaves: int
    """Leaves of all trees."""
    active_leaves: int
    """Leaves that contribute to one value, at most."""
    bytes: int
    """Size of the model file."""
    poses_looked_at: int
    """Random poses that the audit tried."""
    refused_in_range_pct: float
    """Share of random poses in the trained range that the inverse refuses [%]."""
    partial_in_range_pct: float
    """Share of those that are corrected in part [%]."""
    refused_pct: float
    """Share of random poses between the joint limits that the inverse refuses, so that they are not corrected [%]."""
    partial_pct: float
    """Share of them that are corrected in part, near singular poses [%]."""
    refused_where: list[AuditRefusedWhere]
    """The places that hold most of the refusals, at most three, none counted twice."""
    worst_correction_mm_reason: Optional[str] = None
    worst_rotation_deg_reason: Optional[str] = None
    max_correction_mm_reason: Optional[str] = None
    worst_leaf_jump_mm_reason: Optional[str] = None
    sigma_tool_mean_mm_reason: Optional[str] = None
    sigma_beside_mm_reason: Optional[str] = None
    sigma_tool_max_mm_reason: Optional[str] = None


@dataclass(frozen=True)
class Cost:
    instructions: float
    """Instructions of a step at worst, by a sum over the parts of the model, counted for x86-64-v3."""
    instructions_baseline: float
    """The same in the build for every x86-64 processor, in part estimated."""
    step_us: float
    """A whole step of the cycle on this machine, median [us]."""
    worst_us: float
    """Time that 99 % of 2000 steps did not exceed on this machine [us]."""
    cpu: str
    """Processor on which they were timed; empty if the machine does not say."""
    build: str
    """Instruction set of this program."""
    representative: bool
    """The times tell of a machine in production."""
    why_not_representative: list[str]
    """Why the times are not those of a controller."""


@dataclass(frozen=True)
class Compile:
    """Result of plumb compile: Makes the model file."""

    model: str
    """Model file."""
    run: Optional[int]
    """Number of the run it was made of; null with the reason in run_reason."""
    refit_all: bool
    """--refit-all was given: its numbers come from every pose."""
    held_out: Statistics
    """Error of held-out readings; empty with --refit-all."""
    verdict_error: Statistics
    """Held-out error that the verdict rests on: without single readings that stand out."""
    audit: Audit
    """Audit of the model."""
    cost: Cost
    """What a step of the cycle costs."""
    files: list[str]
    """Files that were written, or would be with --dry-run."""
    dry_run: bool
    """--dry-run was given: nothing was written."""
    run_reason: Optional[str] = None


@dataclass(frozen=True)
class Correct:
    """Result of plumb correct: What to command so that the arm reaches a target."""

    rows: int
    """Targets."""
    corrected: int
    """Targets that were corrected."""
    refused: int
    """Targets that were refused."""
    refused_by: dict[str, int]
    """Refused targets by status."""
    likely_mistake: Optional[str]
    """What is likely wrong with the targets; null with the reason in likely_mistake_reason."""
    status: dict[str, int]
    """Rows by status."""
    limited: int
    """Corrections that the guard limited."""
    largest_mm: float
    """Largest correction of the position [mm]."""
    largest_rotation_deg: float
    """Largest correction of the orientation [deg]."""
    files: list[str]
    """Files that were written, or would be with --dry-run."""
    dry_run: bool
    """--dry-run was given: nothing was written."""
    likely_mistake_reason: Optional[str] = None


@dataclass(frozen=True)
class Dbc:
    """Result of plumb dbc: The CAN layout as a DBC file."""

    messages: int
    """Messages."""
    frames: int
    """CAN frames."""
    worst_bus_load_pct: Optional[float]
    """Computed worst-case load of the bus [%]; null with the reason in worst_bus_load_pct_reason."""
    worst_bus_load_pct_reason: Optional[str] = None
    dbc: Optional[str] = None
    """The DBC file."""
    files: Optional[list[str]] = None
    """Files that were written, or would be with --dry-run."""
    dry_run: Optional[bool] = None
    """--dry-run was given: nothing was written."""


@dataclass(frozen=True)
class DemoDemos:
    name: str
    """Name."""
    about: str
    """What it shows."""


@dataclass(frozen=True)
class Demo:
    """Result of plumb demo: Writes a sample cell."""

    demo: Optional[str] = None
    """Name of the sample."""
    directory: Optional[str] = None
    """Folder of the cell."""
    rows: Optional[int] = None
    """Measurements in it."""
    targets: Optional[int] = None
    """Targets for plumb correct in it."""
    files: Optional[list[str]] = None
    """Files that were written, or would be with --dry-run."""
    dry_run: Optional[bool] = None
    """--dry-run was given: nothing was written."""
    demos: Optional[list[DemoDemos]] = None
    """The sample cells."""


@dataclass(frozen=True)
class Deploy:
    """Result of plumb deploy: Writes the folder that plumb-rt runs."""

    run: Optional[int]
    """Number of the run of the model; null with the reason in run_reason."""
    refit_all: bool
    """--refit-all was given: the model's numbers come from every pose."""
    audit: Audit
    """Audit of the model."""
    cost: Cost
    """What a step of the cycle costs."""
    folder: str
    """Folder."""
    files: list[str]
    """Files that were written, or would be with --dry-run."""
    dry_run: bool
    """--dry-run was given: nothing was written."""
    robot_number: int
    """Number of the serial on the bus."""
    model_number: int
    """Number of the model on the bus."""
    mode: Literal["shadow", "limited", "full"]
    """What plumb-rt sends as rt.toml says: nothing, a capped part of the correction, or all of it."""
    key_id: str
    """Id of the key that signed the folder; empty: it is unsigned."""
    max_correction_mm: float
    """Largest correction that the model allows [mm]."""
    worst_bus_load_pct: Optional[float]
    """Computed worst-case load of the bus [%]; null with the reason in worst_bus_load_pct_reason."""
    run_reason: Optional[str] = None
    worst_bus_load_pct_reason: Optional[str] = None


@dataclass(frozen=True)
class DiagnoseRepeatability:
    joint: str
    """Joint."""
    unit: Literal["rad", "m"]
    """Of std."""
    std: Optional[float]
    """1 sigma; 0: none is seen."""
    std_reason: Optional[str] = None


@dataclass(frozen=True)
class DiagnoseHeldOutOrientation:
    """Mean error of held-out orientations, where the fit uses them; else missing."""

    before_deg: Optional[float]
    """At the start [deg]; null with the reason in before_deg_reason."""
    after_deg: Optional[float]
    """With what was added [deg]; null with the reason in after_deg_reason."""
    noise_floor_deg: Optional[float]
    """What the noise of the readings alone makes [deg]; null with the reason in noise_floor_deg_reason."""
    before_deg_reason: Optional[str] = None
    after_deg_reason: Optional[str] = None
    noise_floor_deg_reason: Optional[str] = None


@dataclass(frozen=True)
class DiagnoseAddedMoves:
    after_row: float
    """The last row before it."""
    size_mm: Optional[float]
    """RMS motion of the measured point behind it [mm]; null with the reason in size_mm_reason."""
    size_mm_reason: Optional[str] = None


@dataclass(frozen=True)
class DiagnoseAddedAlternatives:
    effect: str
    """Effect."""
    joints: list[str]
    """Joints."""
    options: dict[str, Union[float, str, bool, list[Any]]]
    """Its options, as in cell.toml."""
    cycles_per_turn: list[float]
    """Cycles a turn of a gear."""
    domain: str
    """What it belongs to: robot, environment, measurement ...."""
    behind_nats: Optional[float]
    """How far its ln_bayes is behind; negative: ahead; null with the reason in behind_nats_reason."""
    behind_nats_reason: Optional[str] = None
    not_shown: Optional[str] = None
    """Why these data cannot show it, if so."""
    measure: Optional[str] = None
    """What to measure so that they can."""


@dataclass(frozen=True)
class DiagnoseAdded:
    effect: str
    """Effect."""
    joints: list[str]
    """Joints."""
    options: dict[str, Union[float, str, bool, list[Any]]]
    """Its options, as in cell.toml."""
    cycles_per_turn: list[float]
    """Cycles a turn of a gear."""
    ln_bayes: Optional[float]
    """Natural logarithm of its Bayes factor; null with the reason in ln_bayes_reason."""
    held_out_mm: Optional[float]
    """Held-out error with it, mean 3-D error [mm]; null with the reason in held_out_mm_reason."""
    held_out_rms_mm: Optional[float]
    """Held-out error with it, RMS [mm]; null with the reason in held_out_rms_mm_reason."""
    alternatives: list[DiagnoseAddedAlternatives]
    """What it may be instead: these poses cannot tell, and predict as well with either."""
    ln_bayes_reason: Optional[str] = None
    held_out_mm_reason: Optional[str] = None
    held_out_rms_mm_reason: Optional[str] = None
    moves: Optional[list[DiagnoseAddedMoves]] = None
    """Of a part of the set-up that moved several times: every move, in order; options.after_row is that of the first."""


@dataclass(frozen=True)
class DiagnoseCandidatesParameters:
    name: str
    """Number of the effect."""
    unit: str
    """Its unit."""
    value: Optional[float]
    """Value; null with the reason in value_reason."""
    std: Optional[float]
    """1 sigma; null with the reason in std_reason."""
    ci95: Optional[float]
    """Half of its 95 % interval; null with the reason in ci95_reason."""
    typical: Optional[float]
    """Typical size; null with the reason in typical_reason."""
    plausible: bool
    """It has a size that occurs."""
    value_reason: Optional[str] = None
    std_reason: Optional[str] = None
    ci95_reason: Optional[str] = None
    typical_reason: Optional[str] = None


@dataclass(frozen=True)
class DiagnoseCandidatesMoves:
    after_row: float
    """The last row before it."""
    size_mm: Optional[float]
    """RMS motion of the measured point behind it [mm]; null with the reason in size_mm_reason."""
    size_mm_reason: Optional[str] = None


@dataclass(frozen=True)
class DiagnoseCandidates:
    effect: str
    """Effect."""
    joints: list[str]
    """Joints."""
    title: str
    """In words."""
    figure: str
    """Figure of plumb plot that shows it at work."""
    ln_bayes: Optional[float]
    """Natural logarithm of its Bayes factor; candidates are ranked by it; null with the reason in ln_bayes_reason."""
    held_out_alone_mm: Optional[float]
    """Held-out error with it alone, mean 3-D error [mm]; null with the reason in held_out_alone_mm_reason."""
    held_out_alone_rms_mm: Optional[float]
    """Held-out error with it alone, RMS [mm]; null with the reason in held_out_alone_rms_mm_reason."""
    held_out_after_mm: Optional[float]
    """Held-out error with it and the first candidate, mean 3-D error [mm]; null with the reason in held_out_after_mm_reason."""
    held_out_after_rms_mm: Optional[float]
    """Held-out error with it and the first candidate, RMS [mm]; null with the reason in held_out_after_rms_mm_reason."""
    gain_pct: Optional[float]
    """Fall of the RMS in folds of the fitted poses [%]; null with the reason in gain_pct_reason."""
    gain_se_pct: Optional[float]
    """Its standard error [%]; null with the reason in gain_se_pct_reason."""
    cycles_per_turn: list[float]
    """Cycles a turn of a gear."""
    domain: str
    """What it belongs to: robot, environment, measurement ...."""
    supported: bool
    """The evidence is enough to add it."""
    plausible: bool
    """Its numbers have sizes that occur."""
    support: str
    """Whether these poses support it, in a word: yes, no, no gain, unlikely, one of 2."""
    options: dict[str, Union[float, str, bool, list[Any]]]
    """Its options, as in cell.toml."""
    parameters: list[DiagnoseCandidatesParameters]
    """Its numbers."""
    share_pct: Optional[float]
    """Share of what the model leaves that it explains [%]; null with the reason in share_pct_reason."""
    absorbed_by_geometry_pct: Optional[float]
    """Share of its motion that the geometry can imitate [%]; null with the reason in absorbed_by_geometry_pct_reason."""
    largest_mm: Optional[float]
    """Largest motion of the measured point that the geometry cannot imitate [mm]; null with the reason in largest_mm_reason."""
    confounded_with: list[str]
    """Effects that these poses cannot tell from it, each once."""
    confounded: list[str]
    """The same with their joints."""
    ln_bayes_reason: Optional[str] = None
    held_out_alone_mm_reason: Optional[str] = None
    held_out_alone_rms_mm_reason: Optional[str] = None
    held_out_after_mm_reason: Optional[str] = None
    held_out_after_rms_mm_reason: Optional[str] = None
    gain_pct_reason: Optional[str] = None
    gain_se_pct_reason: Optional[str] = None
    share_pct_reason: Optional[str] = None
    absorbed_by_geometry_pct_reason: Optional[str] = None
    largest_mm_reason: Optional[str] = None
    moves: Optional[list[DiagnoseCandidatesMoves]] = None
    """Of a part of the set-up that moved several times: every move, in order; options.after_row is that of the first."""
    separate_by: Optional[str] = None
    """How to tell them apart."""


@dataclass(frozen=True)
class DiagnoseAlternatives:
    effect: str
    """Effect."""
    joints: list[str]
    """Joints."""
    options: dict[str, Union[float, str, bool, list[Any]]]
    """Its options, as in cell.toml."""
    cycles_per_turn: list[float]
    """Cycles a turn of a gear."""
    domain: str
    """What it belongs to: robot, environment, measurement ...."""
    behind_nats: Optional[float]
    """How far its ln_bayes is behind; negative: ahead; null with the reason in behind_nats_reason."""
    behind_nats_reason: Optional[str] = None
    not_shown: Optional[str] = None
    """Why these data cannot show it, if so."""
    measure: Optional[str] = None
    """What to measure so that they can."""


@dataclass(frozen=True)
class DiagnoseNotAddedAlternatives:
    effect: str
    """Effect."""
    joints: list[str]
    """Joints."""
    options: dict[str, Union[float, str, bool, list[Any]]]
    """Its options, as in cell.toml."""
    cycles_per_turn: list[float]
    """Cycles a turn of a gear."""
    domain: str
    """What it belongs to: robot, environment, measurement ...."""
    behind_nats: Optional[float]
    """How far its ln_bayes is behind; negative: ahead; null with the reason in behind_nats_reason."""
    behind_nats_reason: Optional[str] = None
    not_shown: Optional[str] = None
    """Why these data cannot show it, if so."""
    measure: Optional[str] = None
    """What to measure so that they can."""


@dataclass(frozen=True)
class DiagnoseNotAddedSlowMotion:
    """What it, a step, may be instead: a part that moves slowly."""

    subject: str
    """What errs."""
    words: str
    """In words."""
    depends_on: list[str]
    """Inputs that it depends on."""
    harmonic: Optional[float]
    """Cycles a turn, if it is periodic; null with the reason in harmonic_reason."""
    share_pct: Optional[float]
    """Share of what the model leaves [%]; null with the reason in share_pct_reason."""
    rms_mm: Optional[float]
    """Motion of the measured point, RMS [mm]; null with the reason in rms_mm_reason."""
    rms_urad: Optional[float]
    """Motion of the joint, RMS [urad]; null with the reason in rms_urad_reason."""
    harmonic_reason: Optional[str] = None
    share_pct_reason: Optional[str] = None
    rms_mm_reason: Optional[str] = None
    rms_urad_reason: Optional[str] = None


@dataclass(frozen=True)
class DiagnoseNotAdded:
    """With --apply: what was supported, but not added, because it may as well be an effect that is thrown away instead of compiled, or the other way round, or because it is a step that may be a slow motion. The effects in added are supported beside it, and without it."""

    effect: str
    """Effect."""
    joints: list[str]
    """Joints."""
    options: dict[str, Union[float, str, bool, list[Any]]]
    """Its options, as in cell.toml."""
    cycles_per_turn: list[float]
    """Cycles a turn of a gear."""
    domain: str
    """What it belongs to: robot, environment, measurement ...."""
    alternatives: list[DiagnoseNotAddedAlternatives]
    """What it may be instead."""
    slow_motion: Optional[DiagnoseNotAddedSlowMotion] = None
    """What it, a step, may be instead: a part that moves slowly."""


@dataclass(frozen=True)
class DiagnoseSlowMotion:
    """What the first candidate, a step, may be instead: a part that moves slowly, as no law of the library describes. Then the verdict is undecidable."""

    subject: str
    """What errs."""
    words: str
    """In words."""
    depends_on: list[str]
    """Inputs that it depends on."""
    harmonic: Optional[float]
    """Cycles a turn, if it is periodic; null with the reason in harmonic_reason."""
    share_pct: Optional[float]
    """Share of what the model leaves [%]; null with the reason in share_pct_reason."""
    rms_mm: Optional[float]
    """Motion of the measured point, RMS [mm]; null with the reason in rms_mm_reason."""
    rms_urad: Optional[float]
    """Motion of the joint, RMS [urad]; null with the reason in rms_urad_reason."""
    harmonic_reason: Optional[str] = None
    share_pct_reason: Optional[str] = None
    rms_mm_reason: Optional[str] = None
    rms_urad_reason: Optional[str] = None


@dataclass(frozen=True)
class DiagnoseGravity:
    """Gravity acts in another direction than cell.toml states, or may do so. Where it is certain, the candidates are those under it, and nothing is added before cell.toml says so."""

    stated: list[float]
    """As cell.toml says, in the base frame [m/s^2]."""
    found: list[float]
    """What explains these poses better, in the base frame [m/s^2]."""
    certain: bool
    """Whether it leads by 10 nats; if not, these poses cannot tell."""
    nats_ahead: Optional[float]
    """How far its best law is ahead of everything under the stated direction [nats]; null with the reason in nats_ahead_reason."""
    nats_ahead_reason: Optional[str] = None


@dataclass(frozen=True)
class DiagnoseNotTestable:
    effect: str
    """Effect."""
    why: str
    """Why these data cannot show it."""
    measure: str
    """What to measure so that they can."""


@dataclass(frozen=True)
class DiagnoseUnknownAlternatives:
    effect: str
    """Effect."""
    joints: list[str]
    """Joints."""
    options: dict[str, Union[float, str, bool, list[Any]]]
    """Its options, as in cell.toml."""
    cycles_per_turn: list[float]
    """Cycles a turn of a gear."""
    domain: str
    """What it belongs to: robot, environment, measurement ...."""
    behind_nats: Optional[float]
    """How far its ln_bayes is behind; negative: ahead; null with the reason in behind_nats_reason."""
    behind_nats_reason: Optional[str] = None
    not_shown: Optional[str] = None
    """Why these data cannot show it, if so."""
    measure: Optional[str] = None
    """What to measure so that they can."""


@dataclass(frozen=True)
class DiagnoseUnknown:
    subject: str
    """What errs."""
    words: str
    """In words."""
    depends_on: list[str]
    """Inputs that it depends on."""
    harmonic: Optional[float]
    """Cycles a turn, if it is periodic; null with the reason in harmonic_reason."""
    share_pct: Optional[float]
    """Share of what the model leaves [%]; null with the reason in share_pct_reason."""
    rms_mm: Optional[float]
    """Motion of the measured point, RMS [mm]; null with the reason in rms_mm_reason."""
    rms_urad: Optional[float]
    """Motion of the joint, RMS [urad]; null with the reason in rms_urad_reason."""
    harmonic_reason: Optional[str] = None
    share_pct_reason: Optional[str] = None
    rms_mm_reason: Optional[str] = None
    rms_urad_reason: Optional[str] = None
    alternatives: Optional[list[DiagnoseUnknownAlternatives]] = None
    """Laws that these data cannot show, which may explain it."""


@dataclass(frozen=True)
class DiagnoseFormulasParameters:
    name: str
    """Name in the formula."""
    unit: str
    """Unit (SI)."""
    value: Optional[float]
    """Fitted; null with the reason in value_reason."""
    std: Optional[float]
    """1 sigma; null with the reason in std_reason."""
    value_reason: Optional[str] = None
    std_reason: Optional[str] = None


@dataclass(frozen=True)
class DiagnoseFormulasCurve:
    """The law along one input; the others stand at their mean, and joints come from below."""

    input: str
    """The input."""
    input_unit: str
    """Its unit (SI)."""
    unit: Literal["rad", "m"]
    """Of what moves."""
    points: list[list[float]]
    """Input and motion."""


@dataclass(frozen=True)
class DiagnoseFormulas:
    formula: str
    """What moves, and by how much: dq5 = k1*sin(q4)*cos(q6)."""
    domain: str
    """What it belongs to: robot, environment or measurement."""
    options: dict[str, Union[float, str, bool, list[Any]]]
    """Its options, as in cell.toml."""
    parameters: list[DiagnoseFormulasParameters]
    """Its fitted numbers."""
    command: str
    """What adds it."""
    held_out_before_mm: Optional[float]
    """Held-out error without it, mean 3-D error [mm]; null with the reason in held_out_before_mm_reason."""
    held_out_before_rms_mm: Optional[float]
    """Held-out error without it, RMS [mm]; null with the reason in held_out_before_rms_mm_reason."""
    held_out_after_mm: Optional[float]
    """Held-out error with it, mean 3-D error [mm]; null with the reason in held_out_after_mm_reason."""
    held_out_after_rms_mm: Optional[float]
    """Held-out error with it, RMS [mm]; null with the reason in held_out_after_rms_mm_reason."""
    fall_mm: Optional[float]
    """By how much the error of an unseen pose falls on average [mm]; null with the reason in fall_mm_reason."""
    fall_se_mm: Optional[float]
    """Standard error of fall_mm [mm]; null with the reason in fall_se_mm_reason."""
    nats: Optional[float]
    """Held-out evidence, its numbers paid for; null with the reason in nats_reason."""
    curve: DiagnoseFormulasCurve
    """The law along one input; the others stand at their mean, and joints come from below."""
    held_out_before_mm_reason: Optional[str] = None
    held_out_before_rms_mm_reason: Optional[str] = None
    held_out_after_mm_reason: Optional[str] = None
    held_out_after_rms_mm_reason: Optional[str] = None
    fall_mm_reason: Optional[str] = None
    fall_se_mm_reason: Optional[str] = None
    nats_reason: Optional[str] = None


@dataclass(frozen=True)
class DiagnoseUnlikely:
    effect: str
    """Effect of the model."""
    joints: list[str]
    """Joints."""
    options: dict[str, Union[float, str, bool, list[Any]]]
    """Its options."""
    times_usual: Optional[float]
    """How many times a usual size it has; null with the reason in times_usual_reason."""
    times_usual_reason: Optional[str] = None


@dataclass(frozen=True)
class DiagnoseLeftOver:
    times_floor: float
    """RMS of the residuals over the noise floor."""
    unavoidable_times: float
    """The same ratio of a right model, because so few poses fit so many numbers."""
    lack_of_fit: bool
    """The residuals exceed what noise and few poses explain."""


@dataclass(frozen=True)
class Diagnose:
    """Result of plumb diagnose: Says which physical effect is missing."""

    verdict: Literal["complete", "missing", "unknown", "undecidable"]
    """Of the model at the start. complete: nothing more is supported; missing: an effect of the library is; unknown: structure that no effect of the library explains; undecidable: too few poses, no noise floor, an exact tie, a law that these poses cannot show or a slow motion explains them as well, what they spoke for was refused, or far more than the noise is left."""
    verdict_text: str
    """The same in words."""
    finding: Optional[Finding]
    """What people ask first, the same object in every verb that judges; null with the reason in finding_reason."""
    blocks: list[Blocks]
    """The result as it is shown, block by block."""
    noise_floor: NoiseFloor
    """The noise floor: what was measured apart from what is only inferred."""
    noise_floor_mm: Optional[float]
    """Mean 3-D error that the noise of the readings alone makes [mm]; null with the reason in noise_floor_mm_reason."""
    noise_floor_rms_mm: Optional[float]
    """RMS of the 3-D error that the noise alone makes [mm]; null with the reason in noise_floor_rms_mm_reason."""
    poses_fit: int
    """Fitted readings."""
    poses_held_out: int
    """Held-out readings."""
    poses_choosing: int
    """Fitted readings that chose the effects: of very many an even choice."""
    folds: int
    """Folds of the held-out figures; 0: one split."""
    nested: bool
    """The effects were chosen anew in every fold."""
    held_out_before_mm: Optional[float]
    """Held-out error at the start, mean 3-D error [mm]; null with the reason in held_out_before_mm_reason."""
    held_out_before_rms_mm: Optional[float]
    """Held-out error at the start, RMS [mm]; null with the reason in held_out_before_rms_mm_reason."""
    held_out_after_mm: Optional[float]
    """Held-out error with what was added, or with the first candidate, mean 3-D error [mm]; null with the reason in held_out_after_mm_reason."""
    held_out_after_rms_mm: Optional[float]
    """Held-out error with what was added, or with the first candidate, RMS [mm]; null with the reason in held_out_after_rms_mm_reason."""
    held_out_before: Statistics
    """All figures of that error."""
    held_out_after: Statistics
    """All figures of that error."""
    added: list[DiagnoseAdded]
    """Effects that --apply added, in this order."""
    candidates: list[DiagnoseCandidates]
    """What was tried, best first."""
    alternatives: list[DiagnoseAlternatives]
    """What the first candidate may be instead: within 10 nats of it (causes by load: also farther behind, where the arm's numbers imitate nearly all of their motion), and mutually confounded with it, so that these poses cannot tell. Not empty: the verdict says A or B."""
    not_testable: list[DiagnoseNotTestable]
    """What could not be tried."""
    unknown: Optional[DiagnoseUnknown]
    """Structure that no effect of the library explains; null with the reason in unknown_reason."""
    formulas: list[DiagnoseFormulas]
    """Laws that fit the unknown structure, best first, at most three; empty where none does, or where nothing is unknown."""
    unlikely: list[DiagnoseUnlikely]
    """Effects of the model that are larger than usual."""
    left_over: Optional[DiagnoseLeftOver]
    """Residuals of the model compared with the noise floor; null with the reason in left_over_reason."""
    outliers: list[str]
    """Poses that were left out because they are far off."""
    blocks_tried: float
    """Regressors that were tried."""
    finding_reason: Optional[str] = None
    noise_floor_mm_reason: Optional[str] = None
    noise_floor_rms_mm_reason: Optional[str] = None
    noise_floor_source: Optional[Literal["repeats", "sigma"]] = None
    """Where it is known from: repeats of poses, or sigma_um of the cell."""
    inferred_floor_mm: Optional[float] = None
    """Mean 3-D error that the scatter of the joints would make, which a diagnosis inferred from what the model leaves; not measured [mm]."""
    repeatability: Optional[list[DiagnoseRepeatability]] = None
    """How far each joint is off at every stop anew, where the readings speak for it; it is in the noise floor."""
    held_out_before_mm_reason: Optional[str] = None
    held_out_before_rms_mm_reason: Optional[str] = None
    held_out_after_mm_reason: Optional[str] = None
    held_out_after_rms_mm_reason: Optional[str] = None
    held_out_orientation: Optional[DiagnoseHeldOutOrientation] = None
    """Mean error of held-out orientations, where the fit uses them; else missing."""
    not_added: Optional[DiagnoseNotAdded] = None
    """With --apply: what was supported, but not added, because it may as well be an effect that is thrown away instead of compiled, or the other way round, or because it is a step that may be a slow motion. The effects in added are supported beside it, and without it."""
    slow_motion: Optional[DiagnoseSlowMotion] = None
    """What the first candidate, a step, may be instead: a part that moves slowly, as no law of the library describes. Then the verdict is undecidable."""
    gravity: Optional[DiagnoseGravity] = None
    """Gravity acts in another direction than cell.toml states, or may do so. Where it is certain, the candidates are those under it, and nothing is added before cell.toml says so."""
    unknown_reason: Optional[str] = None
    verdict_after: Optional[Literal["complete", "missing", "unknown", "undecidable"]] = None
    """The verdict after --apply."""
    verdict_after_text: Optional[str] = None
    """The same in words."""
    left_over_reason: Optional[str] = None
    run: Optional[int] = None
    """Number of the run that --apply kept; null with the reason in run_reason."""
    run_reason: Optional[str] = None
    files: Optional[list[str]] = None
    """Files that were written, or would be with --dry-run."""
    dry_run: Optional[bool] = None
    """--dry-run was given: nothing was written."""


@dataclass(frozen=True)
class DiffParameters:
    name: str
    """Parameter."""
    unit: str
    """Unit of the numbers of this row."""
    a: Optional[float]
    """Value in the earlier run; null with the reason in a_reason."""
    b: Optional[float]
    """Value in the later run; null with the reason in b_reason."""
    change: Optional[float]
    """Later less earlier; null with the reason in change_reason."""
    std: Optional[float]
    """1 sigma of the change; null with the reason in std_reason."""
    a_reason: Optional[str] = None
    b_reason: Optional[str] = None
    change_reason: Optional[str] = None
    std_reason: Optional[str] = None


@dataclass(frozen=True)
class DiffVerdictError:
    """Held-out error that the verdict rests on: without single readings that stand out."""

    a: Statistics
    """Error in the earlier run."""
    b: Statistics
    """Error in the later run."""


@dataclass(frozen=True)
class DiffHeldOut:
    """Error of held-out readings."""

    a: Statistics
    """Error in the earlier run."""
    b: Statistics
    """Error in the later run."""
    change_mean_mm: Optional[float]
    """Change of the mean [mm]; null with the reason in change_mean_mm_reason."""
    change_mean_mm_reason: Optional[str] = None


@dataclass(frozen=True)
class Diff:
    """Result of plumb diff: Says what changed between two runs."""

    a: int
    """Earlier run."""
    b: int
    """Later run."""
    same_measurements: bool
    """Both are of the same files."""
    same_held_out: bool
    """Both hold the same readings out."""
    parameters: list[DiffParameters]
    """Parameters that changed."""
    effects_added: list[str]
    """Effects of the later run only."""
    effects_dropped: list[str]
    """Effects of the earlier run only."""
    verdict_error: DiffVerdictError
    """Held-out error that the verdict rests on: without single readings that stand out."""
    held_out: DiffHeldOut
    """Error of held-out readings."""


@dataclass(frozen=True)
class Drop:
    """Result of plumb drop: Takes an effect out of the model and fits again."""

    effect: str
    """Effect."""
    joints: list[str]
    """Joints."""
    before: Statistics
    """Held-out error before."""
    after: Statistics
    """Held-out error after."""
    run_before: int
    """Number of the run before."""
    finding: Finding
    """What people ask first, the same object in every verb that judges: is it good, where does it fail, why, and what to do next."""
    verdict: str
    """The answer in one sentence."""
    verdict_head: str
    """The same in few words: Good; Not good everywhere; Limited by the measurement."""
    verdict_error: Statistics
    """Held-out error that the verdict rests on: without single readings that stand out."""
    verdict_class: Literal["good", "partly", "bad", "unknown"]
    """good: within tolerance; partly: not everywhere, or something is missing, or the measurement sets the limit; bad; unknown: nothing was held out."""
    run: Optional[int]
    """Number of the run that was kept; null with the reason in run_reason."""
    files: list[str]
    """Files that were written, or would be with --dry-run."""
    dry_run: bool
    """--dry-run was given: nothing was written."""
    run_reason: Optional[str] = None


@dataclass(frozen=True)
class Explain:
    """Result of plumb explain: Offline help."""

    name: Optional[str] = None
    """The word."""
    kind: Optional[Literal["code", "effect", "status", "term"]] = None
    """What it is."""
    text: Optional[str] = None
    """The explanation."""
    code: Optional[list[str]] = None
    """Every code."""
    effect: Optional[list[str]] = None
    """Every effect."""
    status: Optional[list[str]] = None
    """Every status."""
    term: Optional[list[str]] = None
    """Every term."""


@dataclass(frozen=True)
class Export:
    """Result of plumb export: Writes the arm as URDF."""

    joints: int
    """Joints."""
    files: list[str]
    """Files that were written, or would be with --dry-run."""
    dry_run: bool
    """--dry-run was given: nothing was written."""
    run: Optional[int] = None
    """Run of the calibrated arm."""


@dataclass(frozen=True)
class FilterProgramsUntouched:
    file: str
    """File."""
    line: int
    """Line, from 1."""
    target: str
    """Its name, or what stands in its place."""
    why: str
    """Why it was not touched."""
    help: str
    """What to do."""


@dataclass(frozen=True)
class FilterPrograms:
    file: str
    """The program that was read."""
    language: Literal["RAPID", "Fanuc LS", "KRL", "URScript"]
    """Its language."""
    targets: int
    """Targets: those corrected and those in untouched."""
    corrected: int
    """Targets that were corrected."""
    changed: int
    """Corrected targets of which a digit changed."""
    refused: int
    """Targets in untouched whose correction was tried and refused."""
    joint_targets: int
    """Targets of joints that were left as they are, because --joint-targets was not given."""
    untouched: list[FilterProgramsUntouched]
    """Targets that were not corrected."""
    largest_mm: float
    """Largest correction of the position [mm]."""
    rounding_mm: float
    """The most of a corrected position that the digits of the program leave out [mm]."""
    between_targets_mm: Optional[float]
    """Along the linear moves between corrected targets: the largest distance of the true tool from the straight line that was meant, by the model [mm]; null with the reason in between_targets_mm_reason."""
    between_targets_mm_reason: Optional[str] = None
    diff: Optional[str] = None
    """With --dry-run: the changed lines as a unified diff."""


@dataclass(frozen=True)
class Filter:
    """Result of plumb filter: Robot programs with corrected targets."""

    programs: list[FilterPrograms]
    """The programs, each with its data file."""
    files: list[str]
    """Files that were written, or would be with --dry-run."""
    dry_run: bool
    """--dry-run was given: nothing was written."""


@dataclass(frozen=True)
class FitParameters:
    name: str
    """Parameter of the arm or of an effect."""
    value: Optional[float]
    """Fitted value, in unit; null with the reason in value_reason."""
    unit: str
    """Unit of the numbers of this row."""
    std: Optional[float]
    """1 sigma; null with the reason in std_reason."""
    nominal: Optional[float]
    """Nominal value; null with the reason in nominal_reason."""
    change: Optional[float]
    """Fitted less nominal; null with the reason in change_reason."""
    value_reason: Optional[str] = None
    std_reason: Optional[str] = None
    nominal_reason: Optional[str] = None
    change_reason: Optional[str] = None


@dataclass(frozen=True)
class FitHeldOut:
    """Error of held-out readings."""

    n: int
    """How many readings."""
    mean_mm: Optional[float]
    """Mean 3-D position error [mm]; null with the reason in mean_mm_reason."""
    rms_mm: Optional[float]
    """RMS of the 3-D position error [mm]; null with the reason in rms_mm_reason."""
    p95_mm: Optional[float]
    """Error that 95 % of the readings do not exceed [mm]; null with the reason in p95_mm_reason."""
    max_mm: Optional[float]
    """Largest 3-D position error [mm]; null with the reason in max_mm_reason."""
    mean_se_mm: Optional[float]
    """Standard error of the mean, poses counted once [mm]; null with the reason in mean_se_mm_reason."""
    mean_low_mm: Optional[float]
    """Lower end of the 95 % interval of the mean [mm]; null with the reason in mean_low_mm_reason."""
    mean_high_mm: Optional[float]
    """Upper end of the 95 % interval of the mean [mm]; null with the reason in mean_high_mm_reason."""
    mean_mm_reason: Optional[str] = None
    rms_mm_reason: Optional[str] = None
    p95_mm_reason: Optional[str] = None
    max_mm_reason: Optional[str] = None
    mean_se_mm_reason: Optional[str] = None
    mean_low_mm_reason: Optional[str] = None
    mean_high_mm_reason: Optional[str] = None


@dataclass(frozen=True)
class FitOutliers:
    pose: str
    """Pose."""
    set: Literal["fit", "held"]
    """Which set it belongs to."""
    error_mm: Optional[float]
    """Its error [mm]; null with the reason in error_mm_reason."""
    times_usual: Optional[float]
    """How many times the usual scatter that is; null with the reason in times_usual_reason."""
    error_mm_reason: Optional[str] = None
    times_usual_reason: Optional[str] = None


@dataclass(frozen=True)
class FitEffects:
    effect: str
    """Effect."""
    joints: list[str]
    """Joints it is fitted at; empty: it belongs to no joint."""
    name: Optional[str] = None
    """Which formula."""


@dataclass(frozen=True)
class FitFrame:
    """Base in the measurement frame, of the first set-up."""

    xyz_mm: list[float]
    """Position [mm]."""
    quat_wxyz: list[float]
    """Orientation, unit quaternion."""
    fitted: bool
    """It was fitted."""


@dataclass(frozen=True)
class FitArtefactsFound:
    name: str
    """Its label."""
    kind: Literal["plane", "sphere", "anchor"]
    """What it is."""
    normal: Optional[list[float]] = None
    """Of a plane, in the base frame."""
    offset_mm: Optional[float] = None
    """Of a plane: how far the base is from it, along the normal [mm]."""
    position_mm: Optional[list[float]] = None
    """Centre of a sphere, or the anchor, in the base frame [mm]."""
    length_mm: Optional[float] = None
    """Radius of a sphere, or by how much the readings of an anchor are too short [mm]."""
    length_fitted: Optional[bool] = None
    """It was unknown."""


@dataclass(frozen=True)
class FitArtefacts:
    """Planes, spheres and anchors that the readings are about, if they are."""

    found: list[FitArtefactsFound]
    """Each of them, where the fit found it."""
    size_known: bool
    """A length is known, so that the readings tell the size of the arm."""


@dataclass(frozen=True)
class FitPointsTouched:
    name: str
    """Its label."""
    position_mm: list[float]
    """In the base frame [mm]."""


@dataclass(frozen=True)
class FitPointsDistances:
    from_: str
    """Label of one point."""
    to: str
    """Label of the other point."""
    distance_mm: Optional[float]
    """Their distance by the calibrated arm [mm]."""
    half_interval_mm: Optional[float]
    """Half of its 95 % interval [mm]."""
    stated_mm: Optional[float] = None
    """As the columns to_point and distance_mm state it [mm]."""


@dataclass(frozen=True)
class FitPoints:
    """Fixed points that the tool touched, if it did."""

    touched: list[FitPointsTouched]
    """Every point, where the fit found it."""
    distances: list[FitPointsDistances]
    """Between the points of one placement, and those that are stated."""
    size_known: bool
    """A length is known, so that the readings tell the size of the arm."""


@dataclass(frozen=True)
class FitSetupsFrame:
    """Base in the measurement frame."""

    xyz_mm: list[float]
    """Position [mm]."""
    quat_wxyz: list[float]
    """Orientation, unit quaternion."""
    fitted: bool
    """It was fitted."""


@dataclass(frozen=True)
class FitSetups:
    name: str
    """Name of the set-up."""
    frame: FitSetupsFrame
    """Base in the measurement frame."""
    target_mm: list[float]
    """Reflector in the tool frame [mm]."""
    target_fitted: bool
    """It was fitted."""


@dataclass(frozen=True)
class FitTree:
    leaves: list[int]
    """Leaves for x, y, z."""
    leaves_total: int
    """Leaves of all."""
    cv_before_rms_mm: float
    """Cross-validated RMS without the tree [mm]."""
    cv_after_rms_mm: float
    """Cross-validated RMS with the tree [mm]."""
    gain_se_mm: float
    """Standard error of the gain [mm]."""
    reason: str
    """Why it has that size."""


@dataclass(frozen=True)
class FitConvergence:
    """How the fit ended."""

    iterations: int
    """Iterations."""
    sigma0: Optional[float]
    """Square root of chi squared per degree of freedom of the weighted residuals; null with the reason in sigma0_reason."""
    sigma0_reason: Optional[str] = None


@dataclass(frozen=True)
class FitFrom:
    """The earlier run whose numbers were taken over; null with the reason in from_reason."""

    run: str
    """Its folder."""
    numbers: int
    """Numbers of the arm that both have."""
    alike: Literal["same", "sister", "unlike", "unknown"]
    """How much the two arms have in common, as the readings say."""
    same_chance: float
    """Probability that their numbers are as good as equal, one perhaps excepted."""
    share_pct: float
    """Share of the earlier arm's differences from nominal that this one has [%]."""
    spread_mm: float
    """1 sigma of the difference of a length between the two [mm]."""
    spread_mrad: float
    """The same of an angle [mrad]."""
    changed: str
    """The one number in which they differ, or offsets: those of several joints; empty: none."""
    decided_by_readings: float
    """Of all fitted numbers, each by how much the readings decide it."""


@dataclass(frozen=True)
class Fit:
    """Result of plumb fit: Calibrates the arm."""

    poses_fit: int
    """Readings that were fitted."""
    poses_held_out: int
    """Readings that no fit saw."""
    folds: int
    """Folds of the cross validation; 0: one split."""
    parameters: list[FitParameters]
    """What was fitted of the arm."""
    held_parameters: list[str]
    """Parameters that stay nominal because these poses say too little of them."""
    identifiable_rank: int
    """Numbers that these poses identify."""
    calibrability: Optional[float]
    """Condition number of J^T J of the fitted parameters, columns in SI units; null with the reason in calibrability_reason."""
    held_out: FitHeldOut
    """Error of held-out readings."""
    held_out_orientation: Optional[OrientationError]
    """Orientation error of held-out readings; null with the reason in held_out_orientation_reason."""
    fit: Statistics
    """Error of the fitted readings: never accuracy."""
    held_out_without_outliers: Statistics
    """Error of held-out readings without the outliers among them."""
    outliers: list[FitOutliers]
    """Readings that are far off."""
    base: Literal["arm", "controller"]
    """What was calibrated: the nominal arm, or the positions of the controller."""
    nominal: Statistics
    """Held-out error before the calibration."""
    geometry: Statistics
    """Held-out error without the tree."""
    noise_floor: NoiseFloor
    """The noise floor: what was measured apart from what is only inferred."""
    noise_floor_mm: Optional[float]
    """Mean 3-D error that the noise of the readings alone makes [mm]; null with the reason in noise_floor_mm_reason."""
    noise_floor_rms_mm: Optional[float]
    """RMS of the 3-D error that the noise alone makes [mm]; null with the reason in noise_floor_rms_mm_reason."""
    unavoidable_ratio: Optional[float]
    """Held-out RMS over the noise floor that a right model has, because so few poses fit so many numbers; null with the reason in unavoidable_ratio_reason."""
    still_joints: list[str]
    """Joints that never moved in these poses."""
    effects: list[FitEffects]
    """Effects of the model."""
    frame: FitFrame
    """Base in the measurement frame, of the first set-up."""
    target_mm: list[float]
    """Reflector in the tool frame, of the first set-up [mm]."""
    target_fitted: bool
    """It was fitted."""
    measurement_std: dict[str, Any]
    """1 sigma of the numbers of frame and target; the unit stands in each key."""
    tree: Optional[FitTree]
    """The tree; null with the reason in tree_reason."""
    convergence: FitConvergence
    """How the fit ended."""
    from_: Optional[FitFrom]
    """The earlier run whose numbers were taken over; null with the reason in from_reason."""
    tolerance_mm: float
    """Tolerance of the cell [mm]."""
    seed: int
    """Seed of the split."""
    finding: Finding
    """What people ask first, the same object in every verb that judges: is it good, where does it fail, why, and what to do next."""
    blocks: list[Blocks]
    """The result as it is shown, block by block."""
    verdict: str
    """The answer in one sentence."""
    verdict_head: str
    """The same in few words: Good; Not good everywhere; Limited by the measurement."""
    verdict_error: Statistics
    """Held-out error that the verdict rests on: without single readings that stand out."""
    verdict_class: Literal["good", "partly", "bad", "unknown"]
    """good: within tolerance; partly: not everywhere, or something is missing, or the measurement sets the limit; bad; unknown: nothing was held out."""
    run: Optional[int]
    """Number of the run that was kept; null with the reason in run_reason."""
    calibrability_reason: Optional[str] = None
    held_out_orientation_reason: Optional[str] = None
    orientation: Optional[Orientation] = None
    """What the measured orientations are; missing if there are none."""
    noise_floor_mm_reason: Optional[str] = None
    noise_floor_rms_mm_reason: Optional[str] = None
    noise_floor_source: Optional[Literal["repeats", "sigma"]] = None
    """Where it is known from: repeats of poses, or sigma_um of the cell."""
    inferred_floor_mm: Optional[float] = None
    """Mean 3-D error that the scatter of the joints would make, which a diagnosis inferred from what the model leaves; not measured [mm]."""
    unavoidable_ratio_reason: Optional[str] = None
    artefacts: Optional[FitArtefacts] = None
    """Planes, spheres and anchors that the readings are about, if they are."""
    points: Optional[FitPoints] = None
    """Fixed points that the tool touched, if it did."""
    setups: Optional[list[FitSetups]] = None
    """Every set-up, if there are several."""
    tree_reason: Optional[str] = None
    from_reason: Optional[str] = None
    run_reason: Optional[str] = None
    run_directory: Optional[str] = None
    """Folder of the run."""


@dataclass(frozen=True)
class FleetEffects:
    """An effect."""

    effect: str
    """Its name."""
    modelled: int
    """Cells whose model holds it."""
    missing: Optional[int]
    """Cells whose diagnosis names it; null with the reason."""
    diagnosed: int
    """Cells that were diagnosed."""
    missing_reason: Optional[str] = None


@dataclass(frozen=True)
class FleetCellsError:
    """Why it could not be fitted."""

    code: str
    """Its code: plumb explain CODE."""
    message: str
    """What is wrong."""


@dataclass(frozen=True)
class FleetCellsDiagnosis:
    """What --diagnose found."""

    verdict: Literal["complete", "missing", "unknown", "undecidable"]
    """As of plumb diagnose."""
    verdict_text: str
    """The same in words."""
    effect: str
    """Of missing: the first effect; else empty."""
    joints: list[str]
    """And where."""


@dataclass(frozen=True)
class FleetCells:
    """A cell."""

    name: str
    """Of its folder."""
    ok: bool
    """Whether it could be fitted."""
    held_out: Statistics
    """Error of held-out readings."""
    finding: Optional[Finding]
    """What people ask first, the same object in every verb that judges; null if it could not be fitted."""
    verdict: str
    """One sentence about its calibration; empty if it could not be fitted."""
    arm: str
    """As its cell.toml calls it."""
    verdict_head: str
    """The same in few words, as of plumb fit; empty if it could not be fitted."""
    verdict_class: Literal["good", "partly", "bad", "unknown"]
    """As of plumb fit; unknown also if it could not be fitted."""
    good: bool
    """The held-out error keeps the tolerance."""
    effects: list[str]
    """What its model holds."""
    robot: str
    """As the cell calls its robot."""
    model: str
    """Equal for cells with the same nominal arm; empty if it could not be read."""
    unlike_sisters: bool
    """Whether its numbers are unlike those of the other arms of its model."""
    same_measurements_as: Optional[str]
    """Another cell with the same measurements; null with the reason."""
    error: Optional[FleetCellsError]
    """Why it could not be fitted."""
    diagnosis: Optional[FleetCellsDiagnosis]
    """What --diagnose found."""
    finding_reason: Optional[str] = None
    unlike_text: Optional[str] = None
    """In which number, and by how much."""
    same_measurements_as_reason: Optional[str] = None
    error_reason: Optional[str] = None
    diagnosis_reason: Optional[str] = None


@dataclass(frozen=True)
class FleetModelsTypical:
    """A number of the arms of a model."""

    name: str
    """Of the number: J2.d."""
    effect: str
    """geometry, or the effect that it belongs to."""
    parameter: str
    """The same as name."""
    unit: str
    """Of mean and sd."""
    mean: float
    """Mean difference from nominal, or mean size."""
    sd: float
    """Standard deviation from arm to arm."""
    mean_si: float
    """The same in SI."""
    sd_si: float
    """The same in SI."""
    shrinkage: float
    """Share of an arm's own estimate that gives way to the mean, 0 to 1, on average."""
    arms: int
    """Arms that tell."""


@dataclass(frozen=True)
class FleetModelsShares:
    """An effect."""

    effect: str
    """Its name."""
    arms: float
    """Number of arms in which it acts: those whose model holds it, and by probability those whose diagnosis speaks for it."""
    of: float
    """Of so many arms that tell."""
    odds_nats: float
    """What that adds to ln B of the effect in a further arm [nats]."""


@dataclass(frozen=True)
class FleetModels:
    """Cells with the same nominal arm."""

    key: str
    """Equal for arms of this model."""
    robot: str
    """As most of the cells call it."""
    arms: int
    """That could be fitted, copies not counted."""
    unlike_sisters: int
    """So many of them are unlike the others."""
    typical: list[FleetModelsTypical]
    """What is typical of it; empty if there are too few arms."""
    shares: list[FleetModelsShares]
    """Effects of the arm, and in how many of the arms they act; empty if too few arms tell."""


@dataclass(frozen=True)
class FleetTypical:
    """A number of the arms of a model."""

    name: str
    """Of the number: J2.d."""
    effect: str
    """geometry, or the effect that it belongs to."""
    parameter: str
    """The same as name."""
    unit: str
    """Of mean and sd."""
    mean: float
    """Mean difference from nominal, or mean size."""
    sd: float
    """Standard deviation from arm to arm."""
    mean_si: float
    """The same in SI."""
    sd_si: float
    """The same in SI."""
    shrinkage: float
    """Share of an arm's own estimate that gives way to the mean, 0 to 1, on average."""
    arms: int
    """Arms that tell."""
    model: str
    """Key of the model."""


@dataclass(frozen=True)
class Fleet:
    """Result of plumb fleet: Many cells: which arms are good, which is unlike its sisters, what is typical."""

    verdict_text: Optional[str] = None
    """One sentence: how many arms are good, and which need attention."""
    effects: Optional[list[FleetEffects]] = None
    """Every effect, and in how many cells."""
    cells: Optional[list[FleetCells]] = None
    """Cell by cell, by name."""
    models: Optional[list[FleetModels]] = None
    """Model by model, the one with the most arms first."""
    typical: Optional[list[FleetTypical]] = None
    """The typical numbers of all models."""
    file: Optional[str] = None
    """fleet.json, for [fit] prior_from."""
    report: Optional[str] = None
    """The same as a page."""
    share: Optional[str] = None
    """Of --share: which one; no table is made then."""
    done: Optional[int] = None
    """Of --share: its cells with a result."""


@dataclass(frozen=True)
class ImportColumns:
    from_: str
    """Name in the file; empty: derived."""
    to: str
    """Name in measurements.csv."""
    first: str
    """Its first value."""
    last: str
    """Its last value."""


@dataclass(frozen=True)
class Import:
    """Result of plumb import: Turns a tracker's or a controller's text file into measurements.csv."""

    rows: int
    """Rows."""
    separator: str
    """What separates the columns."""
    decimal: str
    """Decimal sign."""
    columns: list[ImportColumns]
    """The columns that were understood."""
    left_out: list[str]
    """Columns that were left out."""
    files: list[str]
    """Files that were written, or would be with --dry-run."""
    dry_run: bool
    """--dry-run or --preview was given: nothing was written."""


@dataclass(frozen=True)
class Pose:
    """A pose."""

    xyz_mm: list[float]
    """Position [mm]."""
    quat_wxyz: list[float]
    """Orientation, unit quaternion."""


@dataclass(frozen=True)
class Twist:
    """A small displacement."""

    d_mm: list[float]
    """Small displacement [mm]."""
    e_deg: list[float]
    """Small rotation vector [deg]."""


@dataclass(frozen=True)
class ChainCoupling:
    joint: int
    """Joint, from 1."""
    by: int
    """The joint that is added, from 1."""
    ratio: float
    """Ratio."""


@dataclass(frozen=True)
class ChainJoints:
    name: str
    """Name of the joint."""
    type: Literal["revolute", "prismatic"]
    """How it moves."""
    alpha_deg: float
    """DH angle alpha [deg]."""
    a_mm: float
    """DH length a [mm]."""
    d_mm: float
    """DH offset d [mm]."""
    theta_deg: float
    """DH angle theta [deg]."""
    beta_deg: float
    """Hayati's angle beta [deg]."""
    scale: float
    """Joint value = scale times reading + offset."""
    pre: Twist
    """Small displacement before the row."""
    post: Twist
    """Small displacement after it."""
    offset_deg: Optional[float] = None
    """Offset of a joint that turns [deg]."""
    offset_mm: Optional[float] = None
    """Offset of a joint that slides [mm]."""
    q_min_deg: Optional[float] = None
    """Lowest reading [deg]."""
    q_min_mm: Optional[float] = None
    """Lowest reading [mm]."""
    q_max_deg: Optional[float] = None
    """Highest reading [deg]."""
    q_max_mm: Optional[float] = None
    """Highest reading [mm]."""


@dataclass(frozen=True)
class Chain:
    """An arm, base to tool."""

    dh_convention: Literal["standard", "modified"]
    """Standard (distal) or modified (Craig)."""
    base: Pose
    """Base of the chain."""
    base_twist: Twist
    """Small displacement of the base."""
    coupling: list[ChainCoupling]
    """The controller's coupling of joints: the angle of the joint is its value plus ratio times that of the other."""
    joints: list[ChainJoints]
    """One row a joint."""
    tool_twist: Twist
    """Small displacement of the tool."""
    tool: Pose
    """Tool centre point in the flange frame."""


@dataclass(frozen=True)
class InspectEffects:
    effect: str
    """Effect."""
    version: int
    """Version of its law."""
    parameters_si: list[float]
    """Its numbers, in SI units."""
    formula: Optional[str] = None
    """Its formula."""


@dataclass(frozen=True)
class InspectTrees:
    axis: Literal["x", "y", "z"]
    """Axis."""
    leaves: int
    """Leaves."""
    depth: int
    """Depth."""
    degree: int
    """Degree of the polynomials."""
    blended: bool
    """Leaves are blended."""


@dataclass(frozen=True)
class InspectDomain:
    joint: str
    """Joint."""
    q_min_deg: Optional[float] = None
    """Lowest trained reading [deg]."""
    q_max_deg: Optional[float] = None
    """Highest trained reading [deg]."""
    q_min_mm: Optional[float] = None
    """Lowest trained reading [mm]."""
    q_max_mm: Optional[float] = None
    """Highest trained reading [mm]."""


@dataclass(frozen=True)
class InspectDomainContext:
    input: str
    """Input."""
    more: dict[str, Any] = field(default_factory=dict)
    """Members whose names depend on the cell."""


@dataclass(frozen=True)
class InspectGuard:
    """Limits of the guard."""

    corrects: Literal["pose", "position"]
    """What is corrected."""
    max_correction_mm: float
    """Largest correction [mm]."""
    max_rotation_deg: float
    """Largest rotation [deg]."""
    slew_mm_per_s: float
    """Largest change of the correction [mm/s]."""
    slew_deg_per_s: float
    """Largest change of the rotation [deg/s]."""
    ramp_s: float
    """Time to ramp in and out [s]."""
    cycle_us: float
    """Cycle [us]."""
    length_scale_mm: float
    """Length that compares rotations with translations [mm]."""
    min_singular_value: float
    """Smallest singular value of the Jacobian, lengths divided by length_scale_mm, below which a pose counts as near-singular."""
    max_seed_distance_deg: float
    """How far a solution may be from its seed [deg]."""


@dataclass(frozen=True)
class InspectProvenanceInputs:
    file: str
    """File."""
    sha256: str
    """Its check sum."""


@dataclass(frozen=True)
class InspectProvenance:
    """Where it comes from."""

    tool_version: str
    """Version of plumb that made it."""
    created: str
    """Date and time, ISO 8601."""
    run: str
    """Run."""
    inputs: list[InspectProvenanceInputs]
    """Files it was made of."""
    poses_fit: int
    """Fitted readings."""
    held_out: Statistics
    """Error of held-out readings."""
    noise_floor_mm: Optional[float]
    """Noise floor [mm]; null with the reason in noise_floor_mm_reason."""
    parameters: list[str]
    """Names of the fitted numbers."""
    noise_floor_mm_reason: Optional[str] = None


@dataclass(frozen=True)
class Inspect:
    """Result of plumb inspect: What is in a model file."""

    file: str
    """Model file."""
    sound: bool
    """It is whole and can be used."""
    schema_read: int
    """Schema version that this program reads."""
    cell: str
    """Name of the cell."""
    robot: str
    """Name of the robot."""
    serial: str
    """Serial number it is bound to."""
    gravity_m_per_s2: list[float]
    """Gravity in the base frame [m/s^2]."""
    nominal: Chain
    """Nominal arm."""
    calibrated: Chain
    """Calibrated arm."""
    effects: list[InspectEffects]
    """Effects."""
    trees: list[InspectTrees]
    """Trees."""
    domain: list[InspectDomain]
    """Trained range of the joints."""
    domain_fade: float
    """Share of the range beyond it over which the tree fades."""
    domain_context: list[InspectDomainContext]
    """Trained range of payload and temperatures."""
    guard: InspectGuard
    """Limits of the guard."""
    provenance: InspectProvenance
    """Where it comes from."""
    audit: Audit
    """Audit of the model."""
    cost: Cost
    """What a step of the cycle costs with it."""


@dataclass(frozen=True)
class Keygen:
    """Result of plumb keygen: A new pair of keys."""

    private_key: str
    """File of the private key, mode 0600."""
    public_key: str
    """File of the public key."""
    key_id: str
    """Its id: the first 16 hexadecimal digits of the SHA-256 of the public key."""


@dataclass(frozen=True)
class ModbusMap:
    """Result of plumb modbus-map: The Modbus registers."""

    messages: int
    """Messages."""
    registers: int
    """Registers."""
    markdown: Optional[str] = None
    """The table as Markdown."""
    csv: Optional[str] = None
    """The table as CSV."""
    files: Optional[list[str]] = None
    """Files that were written, or would be with --dry-run."""
    dry_run: Optional[bool] = None
    """--dry-run was given: nothing was written."""


@dataclass(frozen=True)
class New:
    """Result of plumb new: Writes a commented cell.toml."""

    cell: str
    """Name of the cell."""
    joints: int
    """Joints of the arm."""
    files: list[str]
    """Files that were written, or would be with --dry-run."""
    dry_run: bool
    """--dry-run was given: nothing was written."""


@dataclass(frozen=True)
class PlanPoses:
    pose: str
    """Name of the pose."""
    note: Optional[str] = None
    """Note."""
    more: dict[str, Any] = field(default_factory=dict)
    """Members whose names depend on the cell."""


@dataclass(frozen=True)
class PlanBefore:
    mean_mm: float
    """Mean over random poses [mm]."""
    worst_mm: float
    """Largest over random poses [mm]."""


@dataclass(frozen=True)
class PlanAfter:
    """1 sigma of a predicted point after these poses."""

    mean_mm: float
    """Mean over random poses [mm]."""
    worst_mm: float
    """Largest over random poses [mm]."""


@dataclass(frozen=True)
class PlanShows:
    """A change and how large it must be."""

    part: Literal["tool", "base", "joint", "other"]
    """tool: the tool or the reflector; base: the base or the tracker; joint; other: nothing that a single part explains."""
    joint: Optional[str]
    """Name of the joint; null with the reason in joint_reason."""
    effect: Literal["target", "frame", "offset", "joint_compliance", "reversal", "link", ""]
    """target, frame; of a joint offset, joint_compliance, reversal or link (bent); empty of other."""
    from_mm: float
    """RMS motion of the measured point up to which it may stay unnoticed [mm]."""
    joint_reason: Optional[str] = None


@dataclass(frozen=True)
class PlanExpected:
    """What the readings are expected to say: ln of a Bayes factor [nats]; 10 decide."""

    today_nats: Optional[float]
    """Evidence for the first over the second at the poses measured; null with the reason in today_nats_reason."""
    if_first_nats: float
    """By how much the first is then ahead if it is the true one."""
    if_second_nats: float
    """By how much the second is then ahead if it is the true one."""
    decided_already: bool
    """today_nats is at least 10 either way: nothing more need be measured to tell them apart."""
    decides: bool
    """Both are at least 10."""
    today_nats_reason: Optional[str] = None


@dataclass(frozen=True)
class PlanReproductionBefore:
    """How far the two effects imitate each other before these poses."""

    a_by_b_pct: Optional[float]
    """Share of the motion of the first that the second imitates [%]; null with the reason in a_by_b_pct_reason."""
    b_by_a_pct: Optional[float]
    """Share of the motion of the second that the first imitates [%]; null with the reason in b_by_a_pct_reason."""
    a_by_b_pct_reason: Optional[str] = None
    b_by_a_pct_reason: Optional[str] = None


@dataclass(frozen=True)
class PlanReproductionAfter:
    """How far they imitate each other after these poses."""

    a_by_b_pct: Optional[float]
    """Share of the motion of the first that the second imitates [%]; null with the reason in a_by_b_pct_reason."""
    b_by_a_pct: Optional[float]
    """Share of the motion of the second that the first imitates [%]; null with the reason in b_by_a_pct_reason."""
    a_by_b_pct_reason: Optional[str] = None
    b_by_a_pct_reason: Optional[str] = None


@dataclass(frozen=True)
class PlanNumbers:
    name: str
    """Number of one of the two effects."""
    unit: str
    """Unit of its standard deviations."""
    std_before: Optional[float]
    """1 sigma before these poses; null with the reason in std_before_reason."""
    std_after: float
    """And after."""
    std_before_reason: Optional[str] = None


@dataclass(frozen=True)
class Plan:
    """Result of plumb plan: Chooses the next poses to measure."""

    blocks: list[Blocks]
    """The result as it is shown, block by block."""
    n: int
    """Poses of the plan."""
    poses: list[PlanPoses]
    """The poses to measure."""
    files: list[str]
    """Files that were written, or would be with --dry-run."""
    dry_run: bool
    """--dry-run was given: nothing was written."""
    measured: Optional[int] = None
    """Poses that are measured already."""
    pool: Optional[int] = None
    """Random poses to choose from."""
    parameters: Optional[int] = None
    """Numbers of the model."""
    sigma_um: Optional[float] = None
    """Noise of a reading per axis [um]."""
    ln_det_gain: Optional[float] = None
    """Gain of the logarithm of the determinant of the information matrix."""
    before: Optional[PlanBefore] = None
    """1 sigma of a predicted point before; null with the reason in before_reason."""
    before_reason: Optional[str] = None
    after: Optional[PlanAfter] = None
    """1 sigma of a predicted point after these poses."""
    recheck_of: Optional[int] = None
    """The run that the poses will recheck."""
    shows: Optional[list[PlanShows]] = None
    """The changes that these poses show, and from which size on."""
    separate: Optional[list[str]] = None
    """The two effects."""
    contrast: Optional[str] = None
    """What tells them apart, beside the poses: none, both_sides, short_and_long, cold_and_warm, end_again, two_payloads."""
    contrast_text: Optional[str] = None
    """The same in words."""
    contrasts: Optional[list[str]] = None
    """All that is varied, of the same list."""
    expected: Optional[PlanExpected] = None
    """What the readings are expected to say: ln of a Bayes factor [nats]; 10 decide."""
    reproduction_before: Optional[PlanReproductionBefore] = None
    """How far the two effects imitate each other before these poses."""
    reproduction_after: Optional[PlanReproductionAfter] = None
    """How far they imitate each other after these poses."""
    numbers: Optional[list[PlanNumbers]] = None
    """How well their numbers will be known."""


@dataclass(frozen=True)
class PlotFigures:
    name: str
    """What to type; JN stands for a joint such as J2."""
    shows: str
    """What it shows."""


@dataclass(frozen=True)
class Plot:
    """Result of plumb plot: One figure of a run as an SVG file."""

    figures: Optional[list[PlotFigures]] = None
    """Every figure, with --list."""
    figure: Optional[str] = None
    """The figure that was drawn."""
    run: Optional[int] = None
    """Number of the run that it shows; absent for evidence, which shows the present cell."""
    width_px: Optional[int] = None
    """Width that it was laid out for [px]."""
    files: Optional[list[str]] = None
    """Files that were written, or would be with --dry-run."""
    dry_run: Optional[bool] = None
    """--dry-run was given: nothing was written."""


@dataclass(frozen=True)
class Predict:
    """Result of plumb predict: Where the arm truly is."""

    frame: Union[Literal["base"], Literal["measurement"]]
    """Frame of the predicted points."""
    point: Union[Literal["tool centre point"], Literal["target"]]
    """Point that is predicted."""
    rows: int
    """Rows."""
    status: dict[str, int]
    """Rows by status."""
    files: list[str]
    """Files that were written, or would be with --dry-run."""
    dry_run: bool
    """--dry-run was given: nothing was written."""
    run: Optional[int] = None
    """Number of the run."""
    rows_without_place: Optional[int] = None
    """Rows that an effect needs a place of in the cell's own series, while nothing in the file tells it: they are taken as measured after the last row."""


@dataclass(frozen=True)
class RecheckChangedParameters:
    name: str
    """Name."""
    unit: str
    """Unit of the numbers."""
    value: float
    """Now."""
    std: float
    """1 sigma."""
    change: float
    """Now less before."""


@dataclass(frozen=True)
class RecheckChanged:
    """A change that was found."""

    part: Literal["tool", "base", "joint", "other"]
    """tool: the tool or the reflector; base: the base or the tracker; joint; other: nothing that a single part explains."""
    joint: Optional[str]
    """Name of the joint; null with the reason in joint_reason."""
    effect: Literal["target", "frame", "offset", "joint_compliance", "reversal", "link", ""]
    """target, frame; of a joint offset, joint_compliance, reversal or link (bent); empty of other."""
    ln_bayes: Optional[float]
    """Evidence for the change over its absence, the other changes being there [nats]; null with the reason in ln_bayes_reason."""
    parameters: list[RecheckChangedParameters]
    """The numbers that changed."""
    joint_reason: Optional[str] = None
    ln_bayes_reason: Optional[str] = None
    motion_rms_mm: Optional[float] = None
    """How far the change moves the measured point over the poses of the calibration, RMS [mm]."""
    words: Optional[str] = None
    """What happened, in words."""
    excess: Optional[float] = None
    """Of other: RMS of what is left, in expected ones."""


@dataclass(frozen=True)
class RecheckAlternativesInsteadOf:
    """In the place of which."""

    part: Literal["tool", "base", "joint", "other"]
    """tool: the tool or the reflector; base: the base or the tracker; joint; other: nothing that a single part explains."""
    joint: Optional[str]
    """Name of the joint; null with the reason in joint_reason."""
    effect: Literal["target", "frame", "offset", "joint_compliance", "reversal", "link", ""]
    """target, frame; of a joint offset, joint_compliance, reversal or link (bent); empty of other."""
    joint_reason: Optional[str] = None


@dataclass(frozen=True)
class RecheckAlternatives:
    """Another explanation."""

    part: Literal["tool", "base", "joint", "other"]
    """tool: the tool or the reflector; base: the base or the tracker; joint; other: nothing that a single part explains."""
    joint: Optional[str]
    """Name of the joint; null with the reason in joint_reason."""
    effect: Literal["target", "frame", "offset", "joint_compliance", "reversal", "link", ""]
    """target, frame; of a joint offset, joint_compliance, reversal or link (bent); empty of other."""
    behind_nats: float
    """By how much it explains the readings worse [nats]; negative: better."""
    instead_of: RecheckAlternativesInsteadOf
    """In the place of which."""
    joint_reason: Optional[str] = None


@dataclass(frozen=True)
class RecheckOrientation:
    """Measured orientations against those of the calibration; only where it fitted them and they were measured again."""

    then_mean_deg: float
    """Mean held-out orientation error when the run was made [deg]."""
    mean_deg: float
    """Mean orientation error now, after what was found [deg]."""
    turned: bool
    """Something turns the tool that positions do not show."""
    is_constant: bool
    """One turn of the reflector or the last joint explains it."""


@dataclass(frozen=True)
class RecheckNotShown:
    """A change and how large it must be."""

    part: Literal["tool", "base", "joint", "other"]
    """tool: the tool or the reflector; base: the base or the tracker; joint; other: nothing that a single part explains."""
    joint: Optional[str]
    """Name of the joint; null with the reason in joint_reason."""
    effect: Literal["target", "frame", "offset", "joint_compliance", "reversal", "link", ""]
    """target, frame; of a joint offset, joint_compliance, reversal or link (bent); empty of other."""
    from_mm: float
    """RMS motion of the measured point up to which it may stay unnoticed [mm]."""
    joint_reason: Optional[str] = None


@dataclass(frozen=True)
class Recheck:
    """Result of plumb recheck: Judges few new readings against a run: still true, or what has changed."""

    blocks: list[Blocks]
    """The result as it is shown, block by block."""
    verdict: Literal["true", "changed", "undecidable"]
    """true: nothing has changed that these poses would show; changed: see changed; undecidable: these poses cannot tell."""
    verdict_text: str
    """The same in words."""
    verdict_class: Literal["good", "partly", "bad"]
    """Its colour: good: true; bad: changed; partly: undecidable, or true of a calibration that never kept the tolerance."""
    readings: int
    """Readings that were judged."""
    poses: int
    """Different poses among them."""
    changed: list[RecheckChanged]
    """What has changed, the strongest evidence first."""
    alternatives: list[RecheckAlternatives]
    """Other explanations at most 10 nats behind; below 3 nats one is not ruled out."""
    then: Statistics
    """Held-out error of the run when it was made."""
    before: Statistics
    """Error of the run at these readings."""
    after: Statistics
    """Error after the refit, each reading predicted by a refit without it."""
    expected_mean_mm: float
    """Mean error to be expected at these readings if nothing has changed [mm]."""
    odd_readings: list[int]
    """Rows that contradict all others and were not used, from 1."""
    not_shown: list[RecheckNotShown]
    """Changes that these poses would not show before they exceed what matters."""
    false_alarm_pct: float
    """How often at most such a check finds a change where there is none [%]."""
    parent_run: int
    """The run that was rechecked."""
    run: Optional[int]
    """The run that was kept; null with the reason in run_reason."""
    elsewhere: Optional[int] = None
    """Readings at poses where the calibration had none nearby, so that what the model lacks there has never shown."""
    orientation: Optional[RecheckOrientation] = None
    """Measured orientations against those of the calibration; only where it fitted them and they were measured again."""
    run_reason: Optional[str] = None


@dataclass(frozen=True)
class Report:
    """Result of plumb report: One self-contained HTML file about a run."""

    report: str
    """The HTML file."""
    bytes: int
    """Its size."""
    pages: int
    """Its sections; on paper each begins a new sheet."""
    run: Optional[int]
    """Number of the run; null if --dry-run had to fit first."""
    finding: Finding
    """What people ask first, the same object in every verb that judges: is it good, where does it fail, why, and what to do next."""
    verdict: str
    """Is the calibration good, in one sentence."""
    good: Optional[bool]
    """Whether the held-out readings keep the tolerance; null if none was held out."""
    pdf: Optional[str]
    """The PDF file; null without --pdf."""
    diagnosis: Literal["new", "kept", None]
    """Where the page on what is missing comes from: a new diagnosis, or the one kept with the run by plumb diagnose or an earlier report."""
    files: list[str]
    """Files that were written, or would be with --dry-run."""
    dry_run: bool
    """--dry-run was given: nothing was written."""
    run_reason: Optional[str] = None
    good_reason: Optional[str] = None
    pdf_reason: Optional[str] = None
    diagnosis_reason: Optional[str] = None


@dataclass(frozen=True)
class Runs:
    """Result of plumb runs: Lists the history."""

    runs: list[Run]
    """The runs, oldest first."""
    damaged: list[Union[int, dict[str, Any], str]]
    """Runs that cannot be read."""


@dataclass(frozen=True)
class SimulateSizes:
    effect: str
    """Effect."""
    rms_um: Optional[float]
    """RMS of its displacement [um]; null with the reason in rms_um_reason."""
    visible_um: Optional[float]
    """What geometry cannot imitate of it, RMS per axis [um]; null with the reason in visible_um_reason."""
    rms_um_reason: Optional[str] = None
    visible_um_reason: Optional[str] = None


@dataclass(frozen=True)
class SimulateEffects:
    effect: str
    """Name."""
    about: str
    """What it is."""


@dataclass(frozen=True)
class Simulate:
    """Result of plumb simulate: Simulates measurements of an arm with hidden errors."""

    rows: Optional[int] = None
    """Measurements."""
    poses: Optional[int] = None
    """Distinct poses."""
    noise_um: Optional[float] = None
    """Noise per axis, 1 sigma [um]."""
    outliers: Optional[int] = None
    """Rows that are far off."""
    seed: Optional[int] = None
    """Seed."""
    hidden: Optional[list[str]] = None
    """Effects that are hidden."""
    sizes: Optional[list[SimulateSizes]] = None
    """How large each hidden effect is."""
    files: Optional[list[str]] = None
    """Files that were written, or would be with --dry-run."""
    dry_run: Optional[bool] = None
    """--dry-run was given: nothing was written."""
    effects: Optional[list[SimulateEffects]] = None
    """Effects that --effect takes."""


@dataclass(frozen=True)
class StudyLinks:
    """What the calibration found."""

    L2_mm: float
    """Length of link 2 [mm]."""
    L3_mm: float
    """Length of link 3 [mm]."""
    v2_mm: float
    """Lateral offset of link 2 [mm]."""
    v3_mm: float
    """Lateral offset of link 3 [mm]."""


@dataclass(frozen=True)
class StudyRows:
    key: str
    """Short name of the model."""
    model: str
    """Model in words."""
    size: str
    """Size of the model."""
    kind: Literal["published", "comparison", "ours", "physics"]
    """Group of the table."""
    test_mean_mm: Optional[float]
    """Total error at the test positions of the paper, mean [mm]; null with the reason in test_mean_mm_reason."""
    test_max_mm: Optional[float]
    """Total error at the test positions of the paper, largest [mm]; null with the reason in test_max_mm_reason."""
    unseen_mean_mm: Optional[float]
    """Total error at positions that no model has seen, mean [mm]; null with the reason in unseen_mean_mm_reason."""
    unseen_max_mm: Optional[float]
    """Total error at positions that no model has seen, largest [mm]; null with the reason in unseen_max_mm_reason."""
    leaves: Optional[list[int]] = None
    """Leaves for x and y."""
    degree: Optional[list[int]] = None
    """Degree of the polynomials."""
    paper_mean_mm: Optional[float] = None
    """Total error printed in the paper, mean [mm]; null with the reason in paper_mean_mm_reason."""
    paper_mean_mm_reason: Optional[str] = None
    paper_max_mm: Optional[float] = None
    """Total error printed in the paper, largest [mm]; null with the reason in paper_max_mm_reason."""
    paper_max_mm_reason: Optional[str] = None
    test_mean_mm_reason: Optional[str] = None
    test_max_mm_reason: Optional[str] = None
    unseen_mean_mm_reason: Optional[str] = None
    unseen_max_mm_reason: Optional[str] = None


@dataclass(frozen=True)
class StudyRows2:
    added: str
    """Effects that were added."""
    tree: str
    """Why there is a tree or none."""
    before_mm: float
    """Seen poses without correction [mm]."""
    published_seen_mm: float
    """Seen poses with three trees of five leaves [mm]."""
    noise_seen_mm: float
    """The same trees on white noise [mm]."""
    before_fresh_mm: float
    """Fresh poses without correction [mm]."""
    published_fresh_mm: float
    """Fresh poses with three trees of five leaves [mm]."""
    noise_fresh_mm: float
    """Fresh poses with the trees of noise [mm]."""
    ours_fresh_mm: float
    """Fresh poses after plumb diagnose --apply [mm]."""


@dataclass(frozen=True)
class StudyMedian:
    """Median of all arms."""

    before_mm: float
    """Seen poses without correction [mm]."""
    published_seen_mm: float
    """Seen poses with three trees of five leaves [mm]."""
    noise_seen_mm: float
    """The same trees on white noise [mm]."""
    before_fresh_mm: float
    """Fresh poses without correction [mm]."""
    published_fresh_mm: float
    """Fresh poses with three trees of five leaves [mm]."""
    noise_fresh_mm: float
    """Fresh poses with the trees of noise [mm]."""
    ours_fresh_mm: float
    """Fresh poses after plumb diagnose --apply [mm]."""


@dataclass(frozen=True)
class StudyWorst:
    """Largest of all arms."""

    before_mm: float
    """Seen poses without correction [mm]."""
    published_seen_mm: float
    """Seen poses with three trees of five leaves [mm]."""
    noise_seen_mm: float
    """The same trees on white noise [mm]."""
    before_fresh_mm: float
    """Fresh poses without correction [mm]."""
    published_fresh_mm: float
    """Fresh poses with three trees of five leaves [mm]."""
    noise_fresh_mm: float
    """Fresh poses with the trees of noise [mm]."""
    ours_fresh_mm: float
    """Fresh poses after plumb diagnose --apply [mm]."""


@dataclass(frozen=True)
class Study:
    """Result of plumb study: Reproduces the published study."""

    study: Literal["planar", "six-axis"]
    """Name of the study."""
    variant: Optional[Literal["published", "printed"]] = None
    """Variant of the planar arm."""
    noise_um: Optional[float] = None
    """Noise per axis [um]."""
    seed: Optional[int] = None
    """Seed."""
    links: Optional[StudyLinks] = None
    """What the calibration found."""
    calibrability: Optional[float] = None
    """Condition number of J^T J of the fitted parameters, columns in SI units; null with the reason in calibrability_reason."""
    calibrability_reason: Optional[str] = None
    iterations: Optional[int] = None
    """Iterations."""
    rows: Optional[Union[list[StudyRows], list[StudyRows2]]] = None
    """Planar: one row a model. Six-axis: one row an arm."""
    diagnosis: Optional[str] = None
    """What plumb diagnose says."""
    remarks: Optional[list[str]] = None
    """Remarks."""
    files: Optional[list[str]] = None
    """Files that were written, or would be with --dry-run."""
    dry_run: Optional[bool] = None
    """--dry-run was given: nothing was written."""
    cell: Optional[str] = None
    """Folder of the cell."""
    draws: Optional[int] = None
    """Arms."""
    poses: Optional[int] = None
    """Poses of each."""
    median: Optional[StudyMedian] = None
    """Median of all arms."""
    worst: Optional[StudyWorst] = None
    """Largest of all arms."""
    published_worse_than_nothing: Optional[int] = None
    """Arms that the published trees made worse."""
    ours_worse_than_nothing: Optional[int] = None
    """Arms that plumb made worse."""
