use super::*;

const GRAVITY: f64 = 9.81;

/// Unequal beads on a plate at 30 Hz, t_c of about 0.03 ms.
fn stack() -> (Stack, Plate) {
    let masses = [1.0, 0.6, 1.7, 0.9, 1.1];
    let spring = |(i, m): (usize, &f64)| Spring::linear(5e9 * (1.0 + 0.1 * i as f64), 9e3 * m);
    let springs: Vec<_> = masses.iter().enumerate().map(spring).collect();
    let omega = 60.0 * std::f64::consts::PI;
    let plate = Plate {
        amplitude: 0.4 * GRAVITY / (omega * omega),
        omega,
        phase: 0.3,
        centre: 0.0,
    };
    (Stack::new(&springs, &masses, GRAVITY, plate), plate)
}

/// Accelerations of the gaps, from forces on beads one by one.
fn accelerations(stack: &Stack, plate: Plate, t: f64, gaps: &[f64], rates: &[f64]) -> Vec<f64> {
    let m = stack.masses.len();
    let force = |i: usize| match stack.springs.get(i) {
        Some(spring) => -spring.stiffness * gaps[i] - spring.dashpot * rates[i],
        None => 0.0,
    };
    let floor = -plate.amplitude * plate.omega.powi(2) * (plate.phase + plate.omega * t).sin();
    let bead = |i: usize| (force(i) - force(i + 1)) / stack.masses[i] - GRAVITY;
    (0..m)
        .map(|i| bead(i) - if i == 0 { floor } else { bead(i - 1) })
        .collect()
}

/// The same stack by classical Runge–Kutta steps, an independent method.
fn runge_kutta(stack: &Stack, plate: Plate, state: &[f64], until: f64) -> Vec<f64> {
    let m = stack.masses.len();
    let slope = |t: f64, y: &[f64]| {
        let mut slope = y[m..].to_vec();
        slope.extend(accelerations(stack, plate, t, &y[..m], &y[m..]));
        slope
    };
    let step = |y: &[f64], k: &[f64], h: f64| -> Vec<f64> {
        y.iter().zip(k).map(|(y, k)| y + h * k).collect()
    };
    let steps = 40_000;
    let h = until / f64::from(steps);
    let mut y = state.to_vec();
    for n in 0..steps {
        let t = f64::from(n) * h;
        let a = slope(t, &y);
        let b = slope(t + 0.5 * h, &step(&y, &a, 0.5 * h));
        let c = slope(t + 0.5 * h, &step(&y, &b, 0.5 * h));
        let d = slope(t + h, &step(&y, &c, h));
        for i in 0..2 * m {
            y[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
        }
    }
    y
}

#[test]
fn a_resting_stack_moves_as_its_equations_say() {
    let (mut stack, plate) = stack();
    let m = stack.masses.len();
    // The steady answer, disturbed by a part of the top's overlap.
    let mut state: Vec<f64> = stack.steady(plate.phase).map(|(x, _)| x).collect();
    state.extend(stack.steady(plate.phase).map(|(_, v)| v));
    state[2] += 0.2 * stack.weight[m - 1];
    state[m] += 1e-5;
    let rest = stack
        .rest(&state[..m], &state[m..], plate.phase, f64::INFINITY)
        .expect("it rests");
    let tau = 100.37 * stack.h;
    let (mut gaps, mut rates) = (vec![0.0; m], vec![0.0; m]);
    let now = stack.later(&rest, tau);
    stack.at(&rest, tau, &now, &mut gaps, &mut rates);
    let expected = runge_kutta(&stack, plate, &state, tau);
    for i in 0..m {
        // The error of 40 000 Runge–Kutta steps of a 200th of the fastest time each.
        assert!((gaps[i] / expected[i] - 1.0).abs() < 1e-9, "gap {i}");
        assert!((rates[i] - expected[m + i]).abs() < 1e-13, "rate {i}");
    }
    assert!(stack.energy(&now) < rest.energy);
}

#[test]
fn a_rest_ends_before_the_plate_can_throw() {
    let (mut stack, mut plate) = stack();
    let m = stack.masses.len();
    plate.amplitude *= 5.0;
    stack.answer = answer(&stack.springs, &stack.masses, plate);
    let (gaps, rates): (Vec<_>, Vec<_>) = stack.steady(plate.phase).unzip();
    let rest = stack
        .rest(&gaps, &rates, plate.phase, f64::INFINITY)
        .expect("it rests for a while");
    // α = 2: a rigid stack is thrown at sin θ = 1/2, a soft one about then.
    let thrown = (std::f64::consts::FRAC_PI_6 - plate.phase) / plate.omega;
    assert!((rest.lasts / thrown - 1.0).abs() < 0.1, "{}", rest.lasts);
    let (mut gaps, mut rates) = (vec![0.0; m], vec![0.0; m]);
    let end = stack.later(&rest, rest.lasts);
    stack.at(&rest, rest.lasts, &end, &mut gaps, &mut rates);
    assert!(gaps.iter().all(|&g| g < 0.0));
}
