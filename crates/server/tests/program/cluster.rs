//! A clustered broker. A node dies during a show, and the show goes on.

use serde_json::Value;

use crate::child::Child;
use crate::rabbitmq::Cluster;
use crate::{alone, shows, wait_for};

#[test]
fn a_show_goes_on_when_a_node_of_the_broker_dies() {
    let _turn = alone();
    let Some(mut cluster) = Cluster::start() else { return };
    let urls = cluster.urls();
    // Each robot has its own connection and tries the nodes in turn, so that every node has robots.
    let mut robots = Child::lightbots(&[
        "robots",
        "--count",
        "30",
        "--together",
        "1",
        "--log",
        "info",
        "--broker",
        &urls.join(","),
    ]);
    robots.said("30 robots connected");
    let at = |url: &String| arrivals(&robots, url);
    wait_for("all robots at a node", || (urls.iter().map(at).sum::<usize>() >= 30).then_some(()));
    // The controller connects first to the node that dies, which also has many robots. A busy node may have refused
    // robots, so nodes are sorted by their robots.
    let mut nodes = [1, 2, 0];
    nodes.sort_by_key(|&node| std::cmp::Reverse(at(&urls[node])));
    let show = shows::row_file(30, &[0.1, 0.1, 0.1, 0.1]);
    let brokers = nodes.map(|node| ["--broker", &urls[node]]).concat();
    let all = ["play", &show, "--json", "--log", "info", "--patience", "90"];
    let mut play = Child::lightbots(&[&all[..], &brokers].concat());
    wait_for("the drive to the second picture", || play.err().contains("To frame 2").then_some(()));
    cluster.kill(nodes[0]);
    let code = play.end();
    let report: Value = serde_json::from_str(&play.out()).unwrap_or_default();
    assert_eq!((code, report["ok"].as_bool()), (0, Some(true)), "{report}\n{}", play.err());
    assert_eq!(
        (report["frames_played"].as_u64(), report["dropouts"].as_u64()),
        (Some(4), Some(0)),
        "{report}"
    );
    // A node may refuse the controller once more until the rest of the cluster has formed again.
    assert!(
        arrivals(&play, &urls[nodes[1]]) + arrivals(&play, &urls[nodes[2]]) > 0,
        "it did not move to another node"
    );
}

/// How often the process connected to this node.
fn arrivals(child: &Child, url: &str) -> usize {
    let line = format!("connected to {url}");
    child.err().lines().filter(|said| said.ends_with(&line)).count()
}
