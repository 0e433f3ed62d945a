use std::io::Write;
use std::net::Ipv4Addr;

use axum::Router;
use axum::routing::get;
use tokio::sync::mpsc::{UnboundedReceiver, UnboundedSender, unbounded_channel};

use super::*;

const CLIENT: IpAddr = IpAddr::V4(Ipv4Addr::LOCALHOST);
const OTHER: IpAddr = IpAddr::V4(Ipv4Addr::new(192, 0, 2, 1));
/// A budget that no test uses up.
const LONG: Duration = Duration::from_secs(3_600);

/// Work that runs until it is cancelled, and reports its begin and end.
fn endless(tell: UnboundedSender<&'static str>) -> impl FnOnce(&dyn Fn() -> bool) + Send + 'static {
    move |is_given_up| {
        tell.send("begins").unwrap();
        while !is_given_up() {
            std::thread::yield_now();
        }
        tell.send("ends").unwrap();
    }
}

async fn hears(told: &mut UnboundedReceiver<&'static str>, line: &str) {
    assert_eq!(told.recv().await, Some(line));
}

#[tokio::test]
async fn a_newer_request_of_the_same_client_takes_the_place_of_the_older() {
    let planner = Arc::new(Planner::new(LONG));
    let (tell, mut told) = unbounded_channel();
    let ask = |client: IpAddr, work| {
        let planner = planner.clone();
        tokio::spawn(async move { planner.work(client, work).await })
    };
    let first = ask(CLIENT, endless(tell.clone()));
    hears(&mut told, "begins").await;
    let (tell_other, mut told_other) = unbounded_channel();
    let other = ask(OTHER, endless(tell_other));
    hears(&mut told_other, "begins").await;
    let told_in_turn = tell.clone();
    let second = planner.work(CLIENT, move |_| told_in_turn.send("second").unwrap()).await;
    assert_eq!((first.await.unwrap(), second), (Err(CutOff::Superseded), Ok(())));
    // The second request began only once the first had ended.
    hears(&mut told, "ends").await;
    hears(&mut told, "second").await;
    assert!(told_other.try_recv().is_err(), "other clients are not disturbed");
    other.abort();
    hears(&mut told_other, "ends").await;
}

#[tokio::test]
async fn what_takes_too_long_is_cut_off() {
    let planner = Planner::new(Duration::from_millis(1));
    let (tell, mut told) = unbounded_channel();
    assert_eq!(planner.work(CLIENT, endless(tell)).await, Err(CutOff::TimeUp));
    hears(&mut told, "begins").await;
    hears(&mut told, "ends").await;
}

#[tokio::test]
async fn what_panics_does_not_keep_the_next_from_its_turn() {
    let planner = Planner::new(LONG);
    assert_eq!(planner.work(CLIENT, |_| panic!("on purpose")).await, Err::<(), _>(CutOff::Failed));
    assert_eq!(planner.work(CLIENT, |_| 7).await, Ok(7));
    assert_eq!(planner.work(OTHER, |_| 7).await, Ok(7));
    assert_eq!(planner.clients.lock().unwrap().len(), 1, "a client without work is removed");
}

#[tokio::test]
async fn a_client_that_goes_away_needs_no_plan() {
    let planner = Arc::new(Planner::new(LONG));
    let (tell, mut told) = unbounded_channel();
    let handler = move || {
        let (planner, tell) = (planner.clone(), tell.clone());
        async move { planner.work(CLIENT, endless(tell)).await.map_or("cut off", |()| "done") }
    };
    let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.unwrap();
    let address = listener.local_addr().unwrap();
    let server =
        tokio::spawn(async move { axum::serve(listener, Router::new().route("/", get(handler))).await });
    let mut stream = std::net::TcpStream::connect(address).unwrap();
    stream.write_all(b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n").unwrap();
    hears(&mut told, "begins").await;
    drop(stream);
    hears(&mut told, "ends").await;
    server.abort();
}
