//! What stands below the options in help.

use crate::scene::parameters;

pub(super) const EXAMPLES: &str = "\
Examples:
  beadlab                                the shaken column, soft and hard contacts
                                         side by side
  beadlab fig1a                          a preset; `beadlab presets` lists them
  beadlab fig5b --set alpha=3            the same with another acceleration
  beadlab my-column.toml                 a scene of your own
  beadlab run fig1a --method ed          numbers instead of pictures";

pub(super) const RUN_EXAMPLES: &str = "\
Examples:
  beadlab run fig1b
  beadlab run fig1b --set s0=1e-5 --set n=20 --format json
  beadlab run fig5b --method ed --format csv --every 1e-3 --out trace.csv

Without gravity a run lasts until the floor collision is over, and eps_eff,
er_over_ef and contact_duration are given if that comes before `duration`.
With gravity it lasts for `duration`, and h_cm_mean is the mean absolute height
of the centre of mass over the last 90 % of it, er_over_e_mean the mean E_r over
the mean E. A quantity that the scene does not have is left out. The same scene
and seed give the same bytes, except for wall_time and speed, which measure the
machine and stand only in json.

sigma is the mean time between successive contacts of the same pair, over
contact_time: of a floor collision counted to the end of its last contact, under
gravity over the contacts begun in the last plate period. overlap_max is the
deepest overlap seen (gear, verlet: every 32 steps and at contact changes).

Results are printed to the digits that they have, and one more. What decides the
others is measured without gravity, unless the run is long, else by --sensitivity:
what the last bits of the start and of eps change, and other steps (gear, verlet),
tolerances (power laws) or depths at which a collapse is closed (ed). `sensitivity` is that of eps_eff or h_cm_mean; other
results have their own, as in sigma_sensitivity. Means have an error, statistical
and of the looks between which the motion is not known. Where nothing was
measured a grid vouches for a tenth of a step in a contact time.

energy_drift checks the books, not the results: on a grid it can be 500 times less
than their error, of which step_error is an estimate, from other steps.

verdict is on the scene's soft contacts: detachment, crossover or agreement with
hard spheres; verdict_why says by which numbers. They come from runs of both from
the start that last until they decide, whatever the method and duration of this one.

Unequal beads share one spring and dashpot, so each pair has a restitution of its
own, soft or hard (restitution_min, restitution_max; law = hooke, and ed).

Exit codes: 0 done, 1 the run failed, 2 bad input.";

pub(super) const REPLAY_EXAMPLES: &str = "\
Examples:
  beadlab fig5b --record talk.tape       what is done in the explorer, as lines of text
  beadlab replay talk.tape               once more, to look at again and to go back in
  beadlab replay talk.tape --format text played without pictures, states compared
  beadlab replay talk.tape --format csv --every 1e-3 --column 2

A tape has the scenes, the edits and when they acted, and hashes of the states. It
gives the same bits on every machine; a state that differs is named with its time
(exit code 1). A tape that was cut is played up to there.";

pub(super) const ACCURACY_EXAMPLES: &str = "\
Examples:
  beadlab accuracy                       Fig. 1(b): error against run time
  beadlab accuracy fig1a --set n=50
  beadlab accuracy fig7-md               a chaotic plate: when runs part, and means
  beadlab accuracy --out report          also as CSV, JSON and SVG, in a folder";

pub(super) const ADVISE_EXAMPLES: &str = "\
Examples:
  beadlab advise                         how short must Fig. 1(b)'s contacts be?
  beadlab advise fig1b --set s0=1e-5 --tolerance 0.001
  beadlab advise steel                   a plate: mean E_r/E and h_cm
  beadlab advise steel --against material    longer than steel's own, what changes?
  beadlab advise fig3-hertz --against 1e-7   power laws: against a contact time
  beadlab advise my-column.toml --between 1e-7:1e-4 --out report

The answer is the longest contact time t_c up to which every one that was looked at
keeps eps_eff (without gravity), or the means of E_r/E and h_cm (on a plate that
vibrates), within --tolerance of the limit; then the step, and what a run costs there.
Where means are too uncertain to say, it says so; --budget gives more time.

Exit codes: 0 answered (also when no t_c will do), 1 the limit cannot be measured,
2 bad input.";

pub(super) const STABILITY_EXAMPLES: &str = "\
Examples:
  beadlab stability                      every method on every case
  beadlab stability --steps              the largest stable steps alone
  beadlab stability --budget 10          more time for what is slow
  beadlab stability --format json        every verdict in full";

pub(super) const SWEEP_EXAMPLES: &str = "\
Examples:
  beadlab sweep fig1b --over contact_time=1e-6:1e-3:log:30 --out tc.csv
  beadlab sweep fig1b --over restitution=0.5:0.99:20 --over n=1,2,5,10,20 \\
      --method exact --out map.csv
  beadlab sweep fig1b --over v0=-14:-0.008:log:40 --out v0.csv --resume

Ranges: NAME=START:END:COUNT, both ends included; NAME=START:END:log:COUNT; or a
list NAME=A,B,C. Of several, the last runs fastest. Whole numbers are rounded, and
those that fall together are taken once. Parameters as for `beadlab run --help`.

The file is CSV after lines that begin with #: what was swept, the whole scene, units.
A row is on disk as soon as it and all before it are done, in any number of jobs the
same bytes. After a kill the same command with --resume goes on where it ended. What
a scene does not have is an empty cell; a run that fails leaves its results empty
and its reason in the column `note`.

Exit codes: 0 done, 1 a run failed or the disk is full, 2 bad input (a file that
cannot be opened too), 130 or 143 ended by Ctrl-C or TERM.";

pub(super) const FIGURE_EXAMPLES: &str = "\
Examples:
  beadlab figure 2a                      a figure: its plot, and how near it comes
  beadlab figure table1 --format csv     every number behind it
  beadlab figure plateau                 Fig. 5(b) with ever shorter contacts
  beadlab figure all --out report        the whole paper, as text, CSV, JSON and SVG
  beadlab figure all --quick             the same with fewer points and shorter runs";

pub(super) const PRESET_EXAMPLES: &str = "\
A scene of your own:
  beadlab presets show fig5b > my-column.toml
  beadlab presets check my-column.toml
  beadlab my-column.toml";

/// Below the options of `beadlab run --help`.
pub(super) fn run_long_help() -> String {
    format!("{}\n{RUN_EXAMPLES}", parameters::help())
}
