//! Destinations as users read them.

use interface::{Destination, PlaceFrame, Places, Reply, Request, Waypoint};

/// A destination: the goal or the number of footsteps, and in which frame.
pub(crate) fn places_text(destination: &Destination) -> String {
    let way = match &destination.places {
        Places::Waypoints(waypoints) => {
            let (Waypoint { x, y, heading }, before) = (waypoints[waypoints.len() - 1], waypoints.len() - 1);
            let through = if before == 0 { String::new() } else { format!("{} and ", counted(before, "way-point")) };
            let heading = heading.map_or(String::new(), |heading| {
                format!(", heading {}°", (heading.to_degrees() * 10.0).round() / 10.0 + 0.0)
            });
            format!("{through}goal x {}, y {}{heading}", metres(x), metres(y))
        }
        Places::Footsteps(footsteps) => counted(footsteps.len(), "footstep"),
    };
    let frame = match destination.frame {
        PlaceFrame::Walk => "",
        PlaceFrame::Robot => ", seen from the robot",
    };
    way + frame
}

/// A destination, and when the robot will stand there.
pub(crate) fn destination_text(destination: &Destination, request: &Request, reply: &Reply) -> String {
    let arrival = reply
        .arrival
        .map_or(", farther than the walk is foreseen".to_owned(), |arrival| format!(", there in {arrival:.1} s"));
    // A speed that was not asked for is told where it is not the usual one.
    let asks_speed = request.gait.speed.is_some();
    let speed = if asks_speed || reply.granted.speed == 1.0 { String::new() } else { speed_text(reply.granted.speed) };
    places_text(destination) + &speed + &arrival
}

fn speed_text(speed: f64) -> String {
    format!(", at speed {}", (speed * 1e3).round() / 1e3)
}

fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}

/// The way-point or footstep that the reason is about, before it: `footstep 7: `.
pub(crate) fn place_text(request: &Request, reply: &Reply) -> String {
    reply.place.map_or(String::new(), |number| {
        let kind = match request.destination.map(|destination| destination.places) {
            Some(Places::Waypoints(_)) => "way-point",
            Some(Places::Footsteps(_)) => "footstep",
            None => "place",
        };
        format!("{kind} {number}: ")
    })
}

/// A length as users read it.
pub(crate) fn metres(length: f64) -> String {
    format!("{:.3} m", (length * 1e3).round() / 1e3 + 0.0)
}

#[cfg(test)]
mod tests {
    use interface::{ActiveLimit, Command, Footstep, GaitChange, PlaceList, Reason, Source, Verdict, WalkPose};
    use model::Side;

    use super::*;
    use crate::reply_text::{ReplyJson, reply_text};

    fn reply(verdict: Verdict, reason: Reason) -> Reply {
        Reply { verdict, ..Reply::refused(reason, 12, Command::NOMINAL, None) }
    }

    fn goes_to(places: Places, frame: PlaceFrame) -> Request {
        Request { destination: Some(Destination { frame, places }), ..Request::new(Source::Script) }
    }

    fn footsteps(count: usize) -> Places {
        let footstep = Footstep { side: Side::Left, sole: WalkPose::default() };
        Places::Footsteps(PlaceList::new(&vec![footstep; count]).unwrap())
    }

    fn waypoints(headings: &[Option<f64>]) -> Places {
        let waypoints: Vec<_> = headings.iter().map(|&heading| Waypoint { x: 3.0, y: -2.0, heading }).collect();
        Places::Waypoints(PlaceList::new(&waypoints).unwrap())
    }

    #[test]
    fn the_step_or_way_point_that_is_refused_is_named() {
        let active_limit = Some(ActiveLimit { joint: None, value: 0.512, limit: 0.42 });
        let refused = |reason| Reply { active_limit, place: Some(7), ..reply(Verdict::Refused, reason) };
        assert_eq!(
            reply_text(&goes_to(footsteps(9), PlaceFrame::Walk), &refused(Reason::StepTooFar)),
            "refused: footstep 7: the foot would land too far from the other one (0.512 m, must be at most 0.42 m)"
        );
        let turned = Reply {
            active_limit: active_limit.map(|limit| ActiveLimit { limit: 0.0, ..limit }),
            ..refused(Reason::StepTurn)
        };
        let text = reply_text(&goes_to(footsteps(9), PlaceFrame::Walk), &turned);
        assert!(text.ends_with("(29.335°, must be at most 0°)"), "{text}");
        let not_finite = Reply { place: Some(2), ..reply(Verdict::Refused, Reason::NotFinite) };
        assert_eq!(
            reply_text(&goes_to(waypoints(&[None; 2]), PlaceFrame::Walk), &not_finite),
            "refused: way-point 2: a value is not a finite number"
        );
        assert_eq!(serde_json::to_value(ReplyJson::from(&not_finite)).unwrap()["place"], 2);
    }

    #[test]
    fn a_destination_is_told_with_the_foreseen_arrival() {
        let accepted = Reply { arrival: Some(12.34), ..reply(Verdict::Accepted, Reason::None) };
        let text = |places, frame| reply_text(&goes_to(places, frame), &accepted);
        let heading = Some(90_f64.to_radians());
        assert_eq!(
            text(waypoints(&[heading]), PlaceFrame::Walk),
            "accepted: goal x 3.000 m, y -2.000 m, heading 90°, there in 12.3 s, from half-step 12"
        );
        assert_eq!(
            text(waypoints(&[heading, heading, None]), PlaceFrame::Robot),
            "accepted: 2 way-points and goal x 3.000 m, y -2.000 m, seen from the robot, there in 12.3 s, from \
             half-step 12"
        );
        let faster = Request {
            gait: GaitChange { speed: Some(1.5), ..GaitChange::NONE },
            ..goes_to(footsteps(1), PlaceFrame::Walk)
        };
        let far = Reply { arrival: None, ..accepted };
        assert_eq!(
            reply_text(&faster, &far),
            "accepted: speed 1, 1 footstep, farther than the walk is foreseen, from half-step 12"
        );
        let json = |reply: &Reply| serde_json::to_value(ReplyJson::from(reply)).unwrap();
        assert_eq!((&json(&accepted)["arrival_s"], json(&far).get("arrival_s")), (&12.34.into(), None));
    }
}
