//! Goal: a destination is reached: a goal pose, through way-points, or by given footsteps, each of which is checked
//! before it is granted. Whatever else moves the robot cancels it.
//!
//! Method: lockstep, the truth of the plant. The long version is `survey goals`.

use std::f64::consts::PI;

use controller::Tick;
use dynamics::{pose_seen_from, poses_in_frame_of};
use halfstep_tests::destination::{pose_error, random_footsteps, step_to, true_sole, walk_through, walk_to};
use halfstep_tests::random;
use halfstep_tests::velocity::{random_velocity, true_pose};
use halfstep_tests::walking::Walking;
use interface::{
    Destination, Footstep, GaitChange, Intent, Lifetime, Mode, PlaceFrame, PlaceList, Places, Reason, Reply, Request,
    Source, Verdict, WalkPose, WalkVelocity, Waypoint,
};
use model::Side;
use rand::Rng;

const STOP: Request = Request { intent: Some(Intent::Stop), ..Request::new(Source::Console) };

fn pose(x: f64, y: f64, degrees: f64) -> WalkPose {
    WalkPose { x, y, heading: degrees.to_radians() }
}

fn reply(walking: &mut Walking, request: &Request) -> Reply {
    walking.ask_for(request).reply.expect("a request is answered")
}

fn has_arrived(tick: &Tick) -> bool {
    tick.report.destination.is_some_and(|progress| progress.places_left == 0)
}

/// Walks on until the robot has arrived and is at rest.
fn arrive(walking: &mut Walking) -> Tick {
    let tick = walking.walk_until(60.0, has_arrived).expect("arrives");
    walking.walk(0.5);
    *Box::new(tick)
}

#[test]
fn goals_are_reached_from_a_stand_and_from_a_walk() {
    for (seed, goal) in [pose(1.0, 0.0, 0.0), pose(-0.6, 0.3, 30.0), pose(1.5, -1.2, -170.0)].into_iter().enumerate() {
        for walks in [false, true] {
            let mut walking = if walks { Walking::begin(seed as u64) } else { Walking::stand(seed as u64) };
            let origin = true_pose(&walking);
            walking.walk(if walks { 3.3 } else { 0.2 });
            let granted = reply(&mut walking, &walk_through(&[goal]));
            assert_eq!((granted.verdict, granted.intent), (Verdict::Accepted, Some(Intent::Walk)), "{goal:?}");
            let began = walking.time();
            arrive(&mut walking);
            let took = walking.time() - 0.5 - began;
            let foreseen = granted.arrival.expect("it is near");
            assert!((took - foreseen).abs() < 2.5, "{goal:?}: {took} s instead of {foreseen} s");
            let tick = walking.tick(None);
            assert_eq!((tick.report.mode, has_arrived(&tick)), (Mode::Standing, true));
            let [expected] = poses_in_frame_of(&origin, &[goal]);
            // The walk frame begins in stride with the middle between the feet, and with the mean of their headings.
            let [off, turned] = pose_error(&expected, &true_pose(&walking));
            assert!(off < 0.03 && turned < 0.035, "{goal:?}, walks {walks}: {off} m, {turned} rad");
        }
    }
}

/// A fast walk goes on for a while, and the goal may lie anywhere. What cannot be reached in stride is reached from a
/// stand; without that 4 of 60 such goals are refused, with it 1.
#[test]
fn a_goal_that_a_fast_walk_cannot_turn_to_is_reached_from_a_stand() {
    let mut random = random(10);
    let (mut stopped, mut refused) = (0, 0);
    for (seed, ahead) in [1.1, 0.9, -0.45, 0.7, 1.0, 0.0, 1.1, 0.5, 1.1, -0.3].into_iter().cycle().take(20).enumerate()
    {
        let mut walking = Walking::begin(seed as u64);
        walking.walk(1.0);
        let (left, turn) = (random.random_range(-0.2..0.2), random.random_range(-1.0..1.0));
        let velocity = Some(WalkVelocity { ahead, left, turn });
        reply(&mut walking, &Request { velocity, ..Request::new(Source::Console) });
        walking.walk(random.random_range(3.0..5.0));
        let estimate = walking.tick(None).report.odometry.pose;
        let [goal] = poses_in_frame_of(
            &estimate,
            &[pose(random.random_range(-1.0..1.0), random.random_range(-1.0..1.0), random.random_range(-180.0..180.0))],
        );
        let before = pose_seen_from(&estimate, &goal);
        let [expected] = poses_in_frame_of(&true_pose(&walking), &[before]);
        let granted = reply(&mut walking, &walk_through(&[goal]));
        if granted.verdict == Verdict::Refused {
            refused += 1;
            continue;
        }
        let mut stands = false;
        let arrived = walking.walk_until(60.0, |tick| {
            stands |= tick.report.mode == Mode::Starting;
            has_arrived(tick)
        });
        arrived.expect("arrives");
        walking.walk(0.5);
        stopped += usize::from(stands);
        let [off, turned] = pose_error(&expected, &true_pose(&walking));
        assert!(off < 0.03 && turned < 0.035, "{ahead} m/s: {off} m, {turned} rad");
    }
    assert!((1..10).contains(&stopped) && refused <= 1, "{stopped} of 20 from a stand, {refused} refused");
}

#[test]
fn a_relative_goal_is_seen_from_the_robot() {
    let mut walking = Walking::stand(2);
    for _ in 0..3 {
        let before = true_pose(&walking);
        let waypoint = Waypoint { x: 0.4, y: 0.3, heading: Some(PI / 2.0) };
        let places = Places::Waypoints(PlaceList::new(&[waypoint]).expect("one place"));
        let destination = Some(Destination { frame: PlaceFrame::Robot, places });
        let request = Request { destination, ..Request::new(Source::Console) };
        assert_eq!(reply(&mut walking, &request).verdict, Verdict::Accepted);
        arrive(&mut walking);
        let [expected] = poses_in_frame_of(&before, &[pose(0.4, 0.3, 90.0)]);
        let [off, turned] = pose_error(&expected, &true_pose(&walking));
        assert!(off < 0.02 && turned < 0.02, "{off} m, {turned} rad");
    }
}

#[test]
fn way_points_are_passed_in_their_order() {
    let mut walking = Walking::stand(5);
    let origin = true_pose(&walking);
    let places = [(1.0, 0.0, None), (1.5, 0.8, None), (0.7, 1.2, Some(PI)), (0.0, 0.5, Some(PI / 2.0))];
    let waypoints = places.map(|(x, y, heading)| Waypoint { x, y, heading });
    let request = walk_to(Places::Waypoints(PlaceList::new(&waypoints).expect("four places")));
    assert_ne!(reply(&mut walking, &request).verdict, Verdict::Refused);
    let mut nearest = [f64::INFINITY; 4];
    let mut left = 4;
    while left > 0 {
        let tick = walking.tick(None);
        assert!(!walking.has_fallen(&tick) && walking.time() < 90.0, "at {:.1} s", walking.time());
        let progress = tick.report.destination.expect("it walks there");
        assert!(progress.places_left <= left, "{left} were left, now {}", progress.places_left);
        left = progress.places_left;
        let now = true_pose(&walking);
        for ((x, y, _), nearest) in places.into_iter().zip(&mut nearest) {
            let [place] = poses_in_frame_of(&origin, &[WalkPose { x, y, heading: 0.0 }]);
            *nearest = nearest.min(pose_error(&place, &now)[0]);
        }
    }
    assert!(nearest.iter().all(|&nearest| nearest < 0.25) && nearest[3] < 0.03, "{nearest:?}");
}

#[test]
fn footsteps_land_where_they_were_asked_to() {
    for (seed, first) in [(0, Side::Left), (1, Side::Right), (4, Side::Left)] {
        let mut walking = Walking::stand(seed);
        let origin = true_pose(&walking);
        let footsteps = random_footsteps(&mut random(seed), first);
        let began = walking.walk_until(0.5, |_| false).expect_err("it stands").report.half_step;
        let granted = reply(&mut walking, &step_to(&footsteps));
        assert_ne!(granted.verdict, Verdict::Refused, "{granted:?}");
        // If the other foot is to step first, this one steps in place.
        let first_landed = began.index + 1 + u64::from(first == began.support);
        for (index, footstep) in footsteps.iter().enumerate() {
            let half_step = first_landed + index as u64;
            let bears = |tick: &Tick| {
                tick.report.half_step.index == half_step && (tick.report.half_step.progress > 0.3 || has_arrived(tick))
            };
            walking.walk_until(10.0, bears).expect("walks on");
            let [expected] = poses_in_frame_of(&origin, &[footstep.sole]);
            let [off, turned] = pose_error(&expected, &true_sole(&walking, footstep.side));
            assert!(off < 0.01 && turned < 0.017, "seed {seed}, {index}: {off} m, {turned} rad");
        }
        assert!(has_arrived(&walking.tick(None)));
    }
}

#[test]
fn the_first_footstep_that_cannot_be_made_is_named() {
    let (width, ahead) = (halfstep_tests::mechanism().foot_distance(), 0.2);
    let good: Vec<Footstep> = (0..8_i32)
        .map(|index| {
            let side = if index % 2 == 0 { Side::Left } else { Side::Right };
            let y = if side == Side::Left { 0.5 * width } else { -0.5 * width };
            Footstep { side, sole: WalkPose { x: ahead * f64::from(index + 1), y, heading: 0.0 } }
        })
        .collect();
    let mut walking = Walking::stand(1);
    walking.walk(0.3);
    let mut refused = |change: &dyn Fn(&mut Footstep), reason: &[Reason]| {
        let mut footsteps = good.clone();
        change(&mut footsteps[4]);
        let reply = reply(&mut walking, &step_to(&footsteps));
        assert_eq!((reply.verdict, reply.place), (Verdict::Refused, Some(5)), "{reply:?}");
        assert!(reason.contains(&reply.reason), "{reply:?}");
    };
    refused(&|step| step.sole.x += 0.6, &[Reason::StepTooFar]);
    refused(&|step| step.sole.y += 0.6, &[Reason::StepTooFar]);
    refused(&|step| step.sole.y -= 1.5 * width, &[Reason::FeetCross]);
    refused(&|step| step.sole.heading = 1.2, &[Reason::StepTurn]);
    refused(&|step| step.side = Side::Right, &[Reason::SameFoot]);
    refused(&|step| step.sole.x = f64::NAN, &[Reason::NotFinite]);
    refused(&|step| step.sole.heading = f64::INFINITY, &[Reason::NotFinite]);
    refused(&|step| step.sole.x = 1e9, &[Reason::TooFar]);
    // Onto the other foot: nothing but the simulation sees that.
    refused(
        &|step| (step.sole.x, step.sole.y) = (good[3].sole.x, good[3].sole.y + 0.4 * width),
        &[Reason::SoleClearance, Reason::LegReach, Reason::JointRange],
    );
    let reply = reply(&mut walking, &step_to(&good));
    assert_eq!((reply.verdict, reply.place), (Verdict::Accepted, None), "the others are fine: {reply:?}");
}

#[test]
fn a_destination_is_cancelled_by_whatever_moves_the_robot_and_not_by_a_speed() {
    let goal = walk_through(&[pose(3.0, 1.0, 0.0)]);
    let begin = |seconds: f64| {
        let mut walking = Walking::stand(9);
        assert_eq!(reply(&mut walking, &goal).verdict, Verdict::Accepted);
        walking.walk(seconds);
        walking
    };
    let gait = |gait: GaitChange| Request { gait, ..Request::new(Source::Console) };
    let velocity = WalkVelocity { ahead: 0.3, ..WalkVelocity::default() };
    for (name, request) in [
        ("stop", STOP),
        ("walk", Request { intent: Some(Intent::Walk), ..STOP }),
        ("in place", Request { intent: Some(Intent::InPlace), ..STOP }),
        ("turn", gait(GaitChange { turn: Some(0.1), ..GaitChange::NONE })),
        ("velocity", Request { velocity: Some(velocity), ..Request::new(Source::Console) }),
    ] {
        let mut walking = begin(4.0);
        assert!(walking.tick(None).report.destination.is_some(), "{name}");
        assert_ne!(reply(&mut walking, &request).verdict, Verdict::Refused, "{name}");
        walking.walk(0.1);
        assert_eq!(walking.tick(None).report.destination, None, "{name}");
        let walks = request.intent != Some(Intent::Stop);
        let still_up = walking.walk_until(8.0, |_| false).expect_err("time passes").report.mode;
        let expected = if walks { [Mode::Walking, Mode::InPlace] } else { [Mode::Standing; 2] };
        assert!(expected.contains(&still_up), "{name}: {still_up:?}");
    }
    for seconds in [0.3, 4.0] {
        let mut walking = begin(seconds);
        let faster = gait(GaitChange { speed: Some(1.15), ..GaitChange::NONE });
        let granted = reply(&mut walking, &faster);
        assert_ne!(granted.verdict, Verdict::Refused, "{granted:?}");
        let tick = arrive(&mut walking);
        assert!(tick.report.destination.is_some_and(|progress| progress.distance < 0.02), "{:?}", tick.report);
    }
}

/// A stream that falls silent stops what it asked for, not the way to a destination of a source that outranks it.
#[test]
fn a_destination_outlives_the_stream_of_a_lower_source() {
    let goal = pose(1.5, 0.0, 0.0);
    let stream = Request { lifetime: Lifetime::Streamed, ..Request::new(Source::Script) };
    let walk = Request { intent: Some(Intent::Walk), ..stream };
    for source in [Source::Console, Source::Teleop] {
        let mut walking = Walking::stand(4);
        walking.walk(0.2);
        assert_eq!(reply(&mut walking, &walk).authority, None);
        let granted = reply(&mut walking, &Request { source, ..walk_through(&[goal]) });
        assert_eq!(granted.authority.map(|other| other.source), Some(Source::Script));
        arrive(&mut walking);
    }
    // A stream stops what outranks nobody: another source's walk, and a destination of a lower source.
    let turn = Request { gait: GaitChange { turn: Some(0.1), ..GaitChange::NONE }, ..Request::new(Source::Console) };
    let mut walking = Walking::stand(4);
    walking.walk(0.2);
    reply(&mut walking, &walk);
    assert_eq!(reply(&mut walking, &turn).authority.map(|other| other.source), Some(Source::Script));
    walking.walk(3.0);
    assert_eq!(walking.tick(None).report.mode, Mode::Standing);
    let mut walking = Walking::stand(4);
    walking.walk(0.2);
    reply(&mut walking, &Request { source: Source::Script, ..walk_through(&[goal]) });
    assert_eq!(reply(&mut walking, &Request { source: Source::Teleop, ..stream }).authority, None);
    walking.walk(3.0);
    assert_eq!(walking.tick(None).report.mode, Mode::Standing, "who watched over it has gone");
}

#[test]
fn destinations_and_everything_else_follow_each_other_without_a_fall() {
    for seed in 0..3 {
        let mut walking = Walking::stand(seed);
        let mut random = random(seed);
        let mut next = 0.5;
        while walking.time() < 90.0 {
            let request = (walking.time() >= next).then(|| {
                next = walking.time() + random.random_range(0.1..9.0);
                let places = [(); 3].map(|()| {
                    let [x, y] = [(); 2].map(|()| random.random_range(-2.0..2.0));
                    WalkPose { x, y, heading: random.random_range(-PI..PI) }
                });
                match random.random_range(0..8) {
                    0..4 => walk_through(&places[..random.random_range(1..=3)]),
                    4 => {
                        let first = if random.random() { Side::Left } else { Side::Right };
                        let request = step_to(&random_footsteps(&mut random, first));
                        let destination =
                            request.destination.map(|there| Destination { frame: PlaceFrame::Robot, ..there });
                        Request { destination, ..request }
                    }
                    5 => Request { velocity: Some(random_velocity(&mut random)), ..Request::new(Source::Console) },
                    6 => Request {
                        gait: GaitChange { speed: Some(random.random_range(0.7..1.3)), ..GaitChange::NONE },
                        ..Request::new(Source::Console)
                    },
                    _ => STOP,
                }
            });
            let tick = walking.tick_with(request.as_ref());
            assert!(!walking.has_fallen(&tick), "seed {seed} at {:.2} s", walking.time());
        }
        // Whatever came before, the next goal is reached.
        let estimate = walking.tick(None).report.odometry.pose;
        let [goal] = poses_in_frame_of(&estimate, &[pose(0.6, -0.4, 60.0)]);
        assert_ne!(reply(&mut walking, &walk_through(&[goal])).verdict, Verdict::Refused, "seed {seed}");
        let before = pose_seen_from(&walking.tick(None).report.odometry.pose, &goal);
        let [expected] = poses_in_frame_of(&true_pose(&walking), &[before]);
        arrive(&mut walking);
        let [off, turned] = pose_error(&expected, &true_pose(&walking));
        assert!(off < 0.03 && turned < 0.035, "seed {seed}: {off} m, {turned} rad");
    }
}
