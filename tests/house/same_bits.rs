//! The same scene and seed give the same bytes: today and later, whatever the processor.

use beadlab::scene::preset::embedded;
use std::fmt::Write;

use crate::program::beadlab;

/// What a scene's motion is written as: every number of it with all its digits.
const SERIES: [&str; 4] = ["--format", "csv", "--every", "1e-3"];

/// Motion of every preset under every method, as hashes.
const GOLDEN: &str = include_str!("golden.txt");

/// FNV-1a, 64 bits.
fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// The row of a preset and a method: the hash of what `run` prints, or that it is refused.
fn row(preset: &str, method: &str) -> String {
    // Long enough for a landing and what it does to the column.
    let duration = match method {
        "gear" | "verlet" => "duration=0.06",
        _ => "duration=0.3",
    };
    let scene = ["run", preset, "--method", method, "--set", duration];
    let output = beadlab(&[&scene[..], &SERIES[..]].concat());
    match output.status.code() {
        Some(0) => format!("{preset} {method} {:016x}", hash(&output.stdout)),
        Some(2) => format!("{preset} {method} refused"),
        code => panic!("{preset} {method}: exit {code:?}"),
    }
}

/// Every preset under every method moves as it did when `tests/house/golden.txt` was written, on
/// whatever machine that was: to the last bit, so there is no tolerance. Where a change is
/// meant to move the bits, the table that the failure prints is the new file.
#[test]
fn every_preset_moves_as_it_did() {
    let mut table = String::new();
    for (preset, _) in embedded() {
        for method in ["gear", "verlet", "exact", "ed"] {
            writeln!(table, "{}", row(preset, method)).expect("a string takes all");
        }
    }
    let moved: Vec<_> = table
        .lines()
        .filter(|row| !GOLDEN.lines().any(|golden| golden == *row))
        .collect();
    assert!(
        table == GOLDEN,
        "{} rows are new: {moved:#?}\ntests/house/golden.txt would be:\n{table}",
        moved.len()
    );
}

/// A scene's motion on two processors, told apart by what glibc believes.
#[cfg(all(target_os = "linux", target_env = "gnu", target_arch = "x86_64"))]
mod processors {
    use super::SERIES;
    use std::process::Command;

    /// Tells glibc that the processor has neither fused multiply-adds nor AVX2, in the words of
    /// new and old glibcs; each leaves out those that it does not know.
    const OLD_PROCESSOR: (&str, &str) = (
        "GLIBC_TUNABLES",
        "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-FMA_Usable,-FMA4_Usable,-AVX2_Usable",
    );

    /// What a program prints as things are, and on an older processor.
    fn on_two_processors(program: &str, arguments: &[&str]) -> [Vec<u8>; 2] {
        let printed = |command: &mut Command| {
            let output = command.args(arguments).output().expect("it starts");
            assert!(output.status.success(), "{arguments:?}");
            output.stdout
        };
        [
            printed(Command::new(program).env_remove(OLD_PROCESSOR.0)),
            printed(Command::new(program).env(OLD_PROCESSOR.0, OLD_PROCESSOR.1)),
        ]
    }

    /// What the next test runs to see that its two processors differ.
    #[test]
    #[ignore = "it only prints, for the next test"]
    fn the_system_s_own_bits() {
        let sums = (0..10_000).map(|k| std::hint::black_box(f64::from(k) * 0.37));
        let bits = sums.map(|x| (x.sin() * (-0.01 * x).exp()).to_bits());
        println!("{:x}", bits.fold(0, |hash: u64, x| hash.rotate_left(5) ^ x));
    }

    /// The motion is the same where the system's library, which takes other ways on processors
    /// with and without fused multiply-adds, is not.
    #[test]
    fn motion_does_not_depend_on_the_processor() {
        if std::arch::is_x86_feature_detected!("fma") {
            let this = std::env::current_exe().expect("this test");
            let this = this.to_str().expect("a UTF-8 path");
            let probe = [
                "same_bits::processors::the_system_s_own_bits",
                "--exact",
                "--ignored",
                "--nocapture",
            ];
            let [plain, old] = on_two_processors(this, &probe);
            // The time that the test took is printed too, in its last line.
            let bits = |text: &[u8]| {
                let text = String::from_utf8_lossy(text).into_owned();
                text.split_once("test result")
                    .map(|(bits, _)| bits.to_owned())
            };
            assert!(bits(&plain).is_some_and(|bits| bits.contains("1 test")));
            assert_ne!(bits(&plain), bits(&old), "glibc no longer listens");
        }
        // All of them moved otherwise on the older processor under the system's functions.
        let scenes = [
            "fig5b --set duration=0.2",
            "single-ball --method verlet --set duration=0.3 --set frequency=37",
            "fig5b --method exact --set duration=0.5",
            "fig5b --method ed --set duration=2 --set restitution=0.9",
            "fig6b --method exact --set duration=0.5",
            "steel --method exact --set duration=0.5",
            "shaken --set duration=0.1 --set frequency=31",
            "fig6a --set alpha=2.7 --set duration=2",
            "fig7-ed --set frequency=31",
            "mixed-sizes --method exact --set duration=1",
            "dropped --method exact",
            "fig3-hertz",
            "fig3-hertz --set law=power --set beta=0.7 --set gamma=0.4",
            "fig3-hkk --set v0=-0.07",
            "fig4 --set law=power --set beta=0.3 --set rows=3",
        ];
        for scene in scenes {
            let words: Vec<_> = scene.split(' ').collect();
            same(&[&["run"], &words[..], &SERIES].concat());
        }
        // A session with edits, recorded on one machine; its states are compared too.
        let tape = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/program/session.tape");
        same(&[&["replay", tape], &SERIES[..]].concat());
        same(&["replay", tape]);
    }

    /// The program prints the same bytes on both processors.
    fn same(arguments: &[&str]) {
        let [plain, old] = on_two_processors(env!("CARGO_BIN_EXE_beadlab"), arguments);
        assert!(plain.len() > 200, "{arguments:?}");
        assert!(
            plain == old,
            "{arguments:?}: other bytes on another processor"
        );
    }
}
