//! The motion as CSV: `beadlab run --every`.

use crate::program::{printed, table};

#[test]
fn the_motion_has_a_row_at_every_multiple() {
    let (header, rows) = table(&printed(&[
        "run", "fig1e", "--set", "n=3", "--format", "csv", "--every", "1e-6",
    ]));
    assert_eq!(
        header,
        [
            "time", "floor", "z1", "z2", "z3", "kinetic", "relative", "sigma"
        ]
    );
    let number = |row: usize, column: usize| rows[row][column].parse::<f64>().expect("a number");
    assert!(rows.len() > 5, "{}", rows.len());
    for (row, cells) in rows.iter().enumerate() {
        assert_eq!(
            number(row, 0).to_bits(),
            (row as f64 * 1e-6).to_bits(),
            "row {row}"
        );
        assert_eq!(
            (cells[1].as_str(), cells[7].as_str()),
            ("0.0", ""),
            "no plate, no σ"
        );
    }
    // s0 = 1e-6 apart at the start: reduced heights 1, 2, 3 µm, v = −0.2 m/s.
    for bead in 1..=3 {
        assert!((number(0, 1 + bead) - bead as f64 * 1e-6).abs() < 1e-18);
        assert!((number(1, 1 + bead) - (bead as f64 * 1e-6 - 0.2e-6)).abs() < 1e-15);
    }
    // Energies per mean bead: three beads of unit mass, and none relative yet.
    assert!((number(0, 5) - 3.0 * 0.02).abs() < 1e-15);
    assert!(number(0, 6).abs() < 1e-30);
}

#[test]
fn the_motion_of_a_shaken_column_lasts_for_its_duration() {
    let motion = [
        "run",
        "fig5b",
        "--set",
        "duration=0.1",
        "--format",
        "csv",
        "--every",
        "1e-2",
    ];
    let (header, rows) = table(&printed(&motion));
    assert_eq!(header.len(), 2 + 10 + 3);
    assert_eq!(rows.len(), 11);
    let step = 0.7e-5 / 100.0;
    for (row, cells) in rows.iter().enumerate() {
        let time: f64 = cells[0].parse().expect("a number");
        let asked = row as f64 * 1e-2;
        assert!(
            time <= asked && asked - time < 1.001 * step,
            "grid time {time} for {asked}"
        );
        let floor: f64 = cells[1].parse().expect("a number");
        let plate = 1.24e-3 * (std::f64::consts::TAU * 20.0 * time).sin();
        assert!((floor - plate).abs() < 1e-12, "{floor} {plate}");
    }
}
