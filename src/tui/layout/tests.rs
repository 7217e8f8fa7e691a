//! What a layout must be, at every size.

use super::*;

fn columns(sides: usize) -> Contents {
    Contents {
        sides,
        ..Contents::default()
    }
}

fn all(layout: &Layout) -> Vec<Rect> {
    let mut rects = vec![
        layout.header,
        layout.upper_rule,
        layout.axis,
        layout.lower_rule,
        layout.strips_rule,
        layout.discs,
    ];
    rects.extend([layout.text, layout.notices, layout.verdict]);
    rects.extend([layout.message, layout.keys]);
    let Panels {
        energy,
        relative,
        errors,
        sigma,
        parameters,
    } = layout.panels;
    rects.extend([energy, relative, errors, sigma, parameters]);
    for pane in &layout.panes {
        rects.extend([pane.trace, pane.column, pane.time]);
    }
    rects
}

#[test]
fn nothing_overlaps_and_nothing_leaves_the_screen() {
    for (width, height) in (1..130).flat_map(|w| (1..60).map(move |h| (w, h))) {
        let lattices = [(10, 13), (1, 1), (300, 2)].map(|(rows, columns)| {
            let lattice = Some(LatticeShape { rows, columns });
            (2, u16::from(rows == 1), lattice)
        });
        let columns = [(1, 0), (2, 0), (1, 1), (2, 3)].map(|(s, n)| (s, n, None));
        for (sides, notices, lattice) in columns.into_iter().chain(lattices) {
            let contents = Contents {
                sides,
                notices,
                texts: if sides > 1 { 6 } else { 0 },
                errors: notices > 0,
                lattice,
            };
            let rects = all(&layout((width, height), contents));
            for (k, a) in rects.iter().enumerate().filter(|(_, a)| !a.is_empty()) {
                assert!(
                    a.right() <= width && a.bottom() <= height,
                    "{width}x{height}: {a}"
                );
                for b in rects[k + 1..].iter().filter(|b| !b.is_empty()) {
                    assert!(!a.intersects(*b), "{width}x{height}: {a} and {b}");
                }
            }
        }
    }
}

#[test]
fn everything_needed_to_teach_fits_80_by_24() {
    let layout = layout((80, 24), columns(2));
    assert_eq!(layout.panes.len(), 2);
    assert!(
        layout
            .panes
            .iter()
            .all(|pane| pane.trace.width >= 29 && pane.trace.height >= 10)
    );
    assert!(layout.panes.iter().all(|pane| pane.column.width >= 5));
    let Panels {
        energy,
        relative,
        errors,
        sigma,
        parameters,
    } = layout.panels;
    assert!(errors.is_empty());
    assert!(
        [energy, relative, sigma, parameters]
            .iter()
            .all(|rect| rect.height == 7)
    );
    // A sentence of usual length is whole.
    assert_eq!(layout.message.height, 2);
}

#[test]
fn a_lattice_has_discs_traces_and_panels_at_80_by_24() {
    let contents = Contents {
        lattice: Some(LatticeShape {
            rows: 10,
            columns: 13,
        }),
        ..columns(2)
    };
    let layout = layout((80, 24), contents);
    // Thirteen discs of four dots, and no fewer rows than the screen can spare.
    assert_eq!((layout.discs.width, layout.discs.height), (26, 19));
    assert!(layout.panes[0].trace.width >= 24);
    let Panels {
        energy,
        relative,
        sigma,
        parameters,
        ..
    } = layout.panels;
    assert!(energy.height >= 4 && relative.height >= 4);
    assert!(sigma.width >= 21 && sigma.height >= 6);
    assert!(parameters.width >= 31);
}

/// Wherever there are ten rows the verdict stands in the σ panel or in a row, not in both.
#[test]
fn the_verdict_has_its_place_on_small_screens() {
    let lattice = Some(LatticeShape {
        rows: 10,
        columns: 13,
    });
    for (width, height) in (20..130).flat_map(|w| (10..40).map(move |h| (w, h))) {
        for lattice in [None, lattice] {
            let contents = Contents {
                lattice,
                ..columns(2)
            };
            let layout = layout((width, height), contents);
            let panel = layout.panels.sigma;
            assert_eq!(panel.is_empty(), !layout.verdict.is_empty());
            assert!(panel.is_empty() || (panel.height >= 2 && panel.width >= 21));
        }
    }
}

#[test]
fn texts_stand_where_all_of_them_have_room() {
    let with = |height, texts| {
        let contents = Contents {
            texts,
            ..columns(2)
        };
        layout((120, height), contents)
    };
    assert_eq!(with(36, 6).text.height, 7);
    assert!(with(36, 7).text.is_empty() && with(36, 0).text.is_empty());
    assert_eq!(
        (with(36, 6).message.height, with(36, 7).message.height),
        (1, 2)
    );
}

#[test]
fn a_single_column_has_the_whole_width() {
    assert!(layout((80, 24), columns(1)).panes[0].trace.width >= 60);
}

#[test]
fn what_is_not_asked_for_takes_no_room() {
    let plain = layout((120, 40), columns(2));
    assert!(plain.notices.is_empty() && plain.panels.errors.is_empty());
    let asked = layout(
        (120, 40),
        Contents {
            notices: 1,
            errors: true,
            ..columns(2)
        },
    );
    assert_eq!(asked.notices.height, 1);
    assert!(asked.panels.errors.width >= 15);
}
