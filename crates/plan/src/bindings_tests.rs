use super::*;
use lightbots_base::Rgb;

/// Pixels in a row, left to right, and the names they ask for.
fn frame(pixels: &[(u32, Option<&str>)]) -> Vec<Pixel> {
    let pixel = |(nth, (id, name)): (usize, &(u32, Option<&str>))| Pixel {
        id: *id,
        at: Vec2::new(nth as f64, 1.0),
        color: Rgb::BLACK,
        robot: name.map(str::to_owned),
        ..Pixel::default()
    };
    pixels.iter().enumerate().map(pixel).collect()
}

fn row(robots: usize) -> Vec<Vec2> {
    (0..robots).map(|robot| Vec2::new(robot as f64, 0.0)).collect()
}

fn bind<'a>(bindings: &Bindings, frame: &'a [Pixel], identity: Identity, robots: usize) -> BoundFrame<'a> {
    bindings.bind(frame, identity, &row(robots), |_| false)
}

/// Robots with names; those in `shown` showed pixels, oldest first.
fn bindings(names: &[&str], shown: &[(u32, usize)]) -> Bindings {
    let mut claims = Claims::default();
    shown.iter().for_each(|&(id, robot)| claims.show(id, robot));
    let by_name = names.iter().enumerate().map(|(robot, name)| (name.to_string(), robot)).collect();
    Bindings { by_name, names_known: true, claims, ..Bindings::default() }
}

#[test]
fn a_pixel_that_loses_its_robot_to_a_name_gets_the_one_that_is_left() {
    let all = bindings(&["a", "b", "c"], &[(0, 0), (1, 1), (2, 2)]);
    let frame = frame(&[(0, Some("b")), (1, None), (2, None)]);
    let found = bind(&all, &frame, Identity::Fixed, 3);
    assert_eq!(found.pinned, [Some(1), None, Some(2)]);
    assert_eq!((found.dark, found.issues), (vec![], vec![(1, BindingIssue::Lost)]));
    // Robots that have shown no pixel yet are preferred.
    assert_eq!(bind(&all, &frame, Identity::Fixed, 5).pinned[1], Some(3));
}

#[test]
fn names_and_pins_bind_whatever_the_identity_and_names_come_first() {
    let mut all = bindings(&["a", "b", "c"], &[(0, 0), (1, 1), (2, 2)]);
    all.pins = [(0, Some(2)), (1, Some(0)), (2, None)].into();
    let frame = frame(&[(0, None), (1, None), (2, None), (3, Some("c")), (4, Some("x"))]);
    for identity in [Identity::Any, Identity::Fixed] {
        let found = bind(&all, &frame, identity, 3);
        assert_eq!(found.pixels.iter().map(|pixel| pixel.id).collect::<Vec<_>>(), [1, 3]);
        assert_eq!((found.pinned, found.dark), (vec![Some(0), Some(2)], vec![0, 2, 4]));
        let odd = [(4, BindingIssue::Unknown), (0, BindingIssue::BoundTwice), (2, BindingIssue::Unknown)];
        assert_eq!(found.issues, odd);
    }
}

#[test]
fn of_two_pixels_that_one_robot_showed_it_keeps_the_later() {
    for (shown, pinned) in [([(0, 1), (5, 1)], [None, Some(1)]), ([(5, 1), (0, 1)], [Some(1), None])] {
        let found = bindings(&[], &shown);
        let frame = frame(&[(0, None), (5, None)]);
        assert_eq!(bind(&found, &frame, Identity::Fixed, 2).pinned, pinned);
    }
}

#[test]
fn a_pixel_that_must_stay_dark_leaves_its_robot_to_others() {
    let all = bindings(&["a", "b"], &[(0, 0), (1, 1)]);
    let frame = frame(&[(0, None), (1, None), (2, None)]);
    let found = all.bind(&frame, Identity::Fixed, &row(2), |pixel| pixel.id == 1);
    assert_eq!((found.pinned, found.dark), (vec![Some(0), None], vec![1]));
}

#[test]
fn a_new_name_is_the_robot_that_showed_the_pixel_where_identity_is_fixed() {
    let mut unnamed = bindings(&[], &[(0, 2), (1, 0), (2, 1)]);
    unnamed.names_known = false;
    let named = frame(&[(0, None), (1, Some("ann")), (2, None)]);
    let found = bind(&unnamed, &named, Identity::Fixed, 5);
    assert_eq!(found.pinned, [Some(2), Some(0), Some(1)]);
    unnamed.remember(&found, &[Some(1), Some(2), Some(0)]);
    assert_eq!(unnamed.by_name, [("ann".to_owned(), 0)].into());
    // Bob is another robot, although ann is nearest and showed the pixel.
    let other = frame(&[(1, Some("bob"))]);
    for identity in [Identity::Any, Identity::Fixed] {
        assert!(bind(&unnamed, &other, identity, 5).pinned[0].is_some_and(|robot| robot != 0));
    }
}

#[test]
fn new_names_take_robots_that_keep_a_pixel_only_where_no_others_are_left() {
    let mut known = bindings(&["ann"], &[(0, 0), (1, 1), (2, 2)]);
    known.names_known = false;
    let frame = frame(&[(1, None), (2, None), (7, Some("bob"))]);
    let found = bind(&known, &frame, Identity::Fixed, 4);
    assert_eq!((found.pinned, found.issues.len()), (vec![Some(1), Some(2), Some(3)], 0));
    let found = bind(&known, &frame, Identity::Fixed, 3);
    // Bob cannot be ann: pixel 2 loses the robot that is nearest to bob's pixel.
    assert_eq!(found.pinned, [Some(1), None, Some(2)]);
    assert_eq!(found.issues, [(2, BindingIssue::Lost)]);
}

#[test]
fn with_fewer_robots_the_last_pixels_stay_dark_and_those_with_a_robots_name_last() {
    let mut unbound = Bindings::default();
    let frame = frame(&[(0, None), (1, None), (2, None), (3, Some("ann"))]);
    for identity in [Identity::Any, Identity::Fixed] {
        assert_eq!(bind(&unbound, &frame, identity, 2).dark, [1, 2]);
        assert_eq!(bind(&unbound, &frame, identity, 0).dark, [0, 1, 2, 3]);
    }
    unbound.claims.show(2, 0);
    assert_eq!(bind(&unbound, &frame, Identity::Fixed, 2).dark, [0, 1]);
}

#[test]
fn claims_are_told_oldest_first_and_can_be_forgotten() {
    let mut claims = Claims::default();
    [(4, 'a'), (2, 'b'), (4, 'c')].into_iter().for_each(|(id, robot)| claims.show(id, robot));
    assert_eq!(claims.oldest_first(), [(2, 'b'), (4, 'c')]);
    claims.forget('b');
    assert_eq!(claims.oldest_first(), [(4, 'c')]);
    claims.clear();
    claims.show(1, 'd');
    assert_eq!(claims.oldest_first(), [(1, 'd')]);
}
