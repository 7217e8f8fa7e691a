//! The scene's soft column and the same column of hard spheres, side by side.

use super::column::{FollowedColumn, Missing, SLICES};
use super::{Compared, LIKELY, SURE, Verdict, decide};
use crate::scene::{CollisionRule, Facts, Method, MethodName, Scene, SceneError, Shake};
use crate::study::{RunError, Watch};

/// Periods of the first look at the means; every next is after twice as many.
const FIRST_PERIODS: usize = 50;
const MOST_PERIODS: usize = 12_800;

/// The verdict on a scene. The same scene has the same verdict on every machine: work is
/// counted, not timed.
///
/// # Errors
/// [`RunError::Stopped`] when who looks on stops it.
pub fn verdict(scene: &Scene, watch: &mut Watch) -> Result<Verdict, RunError> {
    if scene.contact_time().is_none() {
        return Ok(Verdict::none("hard spheres have no contact time"));
    }
    if scene.n == 1 {
        let why = "a single bead has no two contacts that could overlap in time";
        return Ok(Verdict::none(why));
    }
    if scene.sites().is_some() {
        let why = "there are no hard discs to compare a lattice with";
        return Ok(Verdict::by_sigma0(scene, why));
    }
    let mut columns = match columns(scene, SLICES) {
        Ok(columns) => columns,
        Err(error) => return Ok(Verdict::by_sigma0(scene, &error.to_string())),
    };
    let compared = match (scene.gravity, scene.shake()) {
        (None, _) => launched(scene, &mut columns, watch),
        (Some(_), Some(Shake { amplitude, .. })) if amplitude > 0.0 => {
            shaken(amplitude, &mut columns, watch)
        }
        _ => falling(&mut columns, watch),
    };
    match compared {
        Ok(verdict) => Ok(verdict),
        Err(Missing::Stopped(error)) => Err(error),
        Err(Missing::Why(why)) if scene.gravity.is_none() => Ok(Verdict::by_sigma0(scene, &why)),
        Err(Missing::Why(why)) => Ok(columns[0].by_landings(&why)),
    }
}

/// The soft column under the exact method (hard spheres with the TC rule stay what they
/// are), and the same column of plain hard spheres; however short the scene's own run.
pub(super) fn columns(scene: &Scene, allowed: u64) -> Result<[FollowedColumn; 2], SceneError> {
    let soft = if scene.is_md() {
        scene.with_method(MethodName::Exact)?
    } else {
        scene.clone()
    };
    let hard = Facts {
        method: Method::Hard(CollisionRule::Lrv),
        ..scene.facts().clone()
    };
    Ok([
        FollowedColumn::new(soft, "soft contacts", allowed),
        FollowedColumn::new(Scene::new(hard)?, "hard spheres", allowed),
    ])
}

/// A floor collision without gravity: ε_eff of both.
fn launched(
    scene: &Scene,
    [soft, hard]: &mut [FollowedColumn; 2],
    watch: &mut Watch,
) -> Result<Verdict, Missing> {
    let found = [soft.collide(watch)?, hard.collide(watch)?];
    let compared = [Compared::eps_eff("eps_eff", found), Compared::loss(found)];
    let sigma = scene.sigma0();
    let sigma = sigma.map_or_else(String::new, |sigma| format!("; {}", super::sigma0(sigma)));
    Ok(Verdict::of(&compared, decide(&compared, SURE), &sigma))
}

/// A column that falls on a floor at rest: ε_eff of the last bounce, when all are at rest.
fn falling([soft, hard]: &mut [FollowedColumn; 2], watch: &mut Watch) -> Result<Verdict, Missing> {
    let found = [soft.settle(watch)?, hard.settle(watch)?];
    let compared = [Compared::eps_eff("eps_eff of the last bounce", found)];
    let more = "; the beads touch in the end, where sigma -> 0 at any t_c";
    Ok(Verdict {
        // The bounce of a moment, and of a chaotic motion.
        decisive: None,
        ..Verdict::of(&compared, decide(&compared, SURE), more)
    })
}

/// A column on a plate: means over ever more periods, until they decide or the work is
/// spent.
fn shaken(
    amplitude: f64,
    [soft, hard]: &mut [FollowedColumn; 2],
    watch: &mut Watch,
) -> Result<Verdict, Missing> {
    let mut periods = FIRST_PERIODS;
    loop {
        soft.follow(periods, watch)?;
        hard.follow(periods, watch)?;
        let compared = soft.means(hard, amplitude)?;
        let last = soft.is_spent() || hard.is_spent() || 2 * periods > MOST_PERIODS;
        let sure = decide(&compared, SURE);
        let word = sure.or_else(|| decide(&compared, LIKELY).filter(|_| last));
        if word.is_some() || last {
            return Ok(Verdict::of(&compared, word, &soft.told()));
        }
        periods *= 2;
    }
}
