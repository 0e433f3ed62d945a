//! A RabbitMQ cluster of three nodes on this machine.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use crate::child::Child;
use crate::mosquitto::free_port;
use crate::{shows, wait_for};

/// Debian's start script. The script of the same name on the `PATH` changes the user first.
const DEBIAN: &str = "/usr/lib/rabbitmq/bin/rabbitmq-server";

struct Node {
    child: Child,
    mqtt: u16,
}

/// A running cluster. Dropping it ends its processes.
pub struct Cluster {
    nodes: Vec<Node>,
    /// The name server (epmd), by which the nodes find each other.
    _names: Child,
}

impl Cluster {
    /// Starts a cluster. `None` if RabbitMQ is not installed.
    pub fn start() -> Option<Self> {
        let program = if Path::new(DEBIAN).exists() { DEBIAN } else { "rabbitmq-server" };
        if !has(program) || !has("epmd") {
            eprintln!(
                "NOT TESTED: a cluster of brokers: RabbitMQ is missing (apt-get install rabbitmq-server)"
            );
            return None;
        }
        let names_port = free_port();
        let mut command = Command::new("epmd");
        command.args(["-address", "127.0.0.1", "-port", &names_port.to_string()]);
        let names = Child::start(command, "epmd");
        let folder = PathBuf::from(shows::file("cluster", "")).with_extension("d");
        let mut cluster = Self { nodes: Vec::new(), _names: names };
        // Nodes start one after another, because nodes that start at the same time may never agree on the registry of
        // client ids.
        for number in 1..=3 {
            cluster.nodes.push(node(program, &folder, number, names_port));
            cluster.wait();
        }
        Some(cluster)
    }

    /// The address of each node.
    pub fn urls(&self) -> Vec<String> {
        self.nodes.iter().map(|node| format!("mqtt://127.0.0.1:{}", node.mqtt)).collect()
    }

    /// Kills one of the nodes.
    pub fn kill(&mut self, node: usize) {
        self.nodes[node].child.kill_group();
    }

    /// Waits until every node that was added says that it has started, and then until each accepts a client. Before
    /// that, the nodes may still synchronise their clients.
    fn wait(&mut self) {
        for node in &mut self.nodes {
            let child = &mut node.child;
            wait_for("RabbitMQ", || {
                assert!(child.exit_code().is_none(), "a node ended: {}", child.out());
                child.out().contains("Starting broker... completed").then_some(())
            });
        }
        for node in &self.nodes {
            wait_for("RabbitMQ to let a client in", || lets_in(node.mqtt).ok().filter(|&is| is).map(|_| ()));
        }
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        for node in &mut self.nodes {
            node.child.kill_group();
        }
    }
}

/// Whether a node answers a CONNECT (MQTT 3.1.1, clean session) with a CONNACK that accepts it.
fn lets_in(port: u16) -> std::io::Result<bool> {
    let mut stream = TcpStream::connect(("127.0.0.1", port))?;
    stream.set_read_timeout(Some(Duration::from_secs(5)))?;
    stream.write_all(b"\x10\x11\x00\x04MQTT\x04\x02\x00\x3c\x00\x05probe")?;
    let mut answer = [0; 4];
    stream.read_exact(&mut answer)?;
    stream.write_all(b"\xe0\x00")?;
    Ok(answer == [0x20, 2, 0, 0])
}

fn has(program: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    Path::new(program).is_file() || std::env::split_paths(&path).any(|folder| folder.join(program).is_file())
}

fn node(program: &str, folder: &Path, number: usize, names_port: u16) -> Node {
    let home = folder.join(number.to_string());
    std::fs::create_dir_all(&home).unwrap();
    let write = |name: &str, text: &str| {
        let path = home.join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let cookie = write(".erlang.cookie", "LIGHTBOTSTEST");
    std::fs::set_permissions(&cookie, std::os::unix::fs::PermissionsExt::from_mode(0o400)).unwrap();
    let mqtt = free_port();
    let settings = settings(mqtt);
    let mut command = Command::new(program);
    command
        .env_clear()
        .env("PATH", std::env::var_os("PATH").unwrap_or_default())
        .env("HOME", &home)
        .env("RABBITMQ_NODENAME", format!("lightbots{number}@localhost"))
        .env("RABBITMQ_MNESIA_BASE", home.join("mnesia"))
        .env("RABBITMQ_LOG_BASE", home.join("log"))
        .env("RABBITMQ_ENABLED_PLUGINS_FILE", write("plugins", "[rabbitmq_mqtt]."))
        .env("RABBITMQ_CONFIG_FILE", write("rabbitmq.conf", &settings))
        .env("RABBITMQ_DIST_PORT", free_port().to_string())
        .env("RABBITMQ_CONF_ENV_FILE", "/dev/null")
        .env("ERL_EPMD_ADDRESS", "127.0.0.1")
        .env("ERL_EPMD_PORT", names_port.to_string())
        .env("RABBITMQ_SERVER_ADDITIONAL_ERL_ARGS", "-kernel inet_dist_use_interface {127,0,0,1}")
        // The script starts the node as a child process, and a group ends both.
        .process_group(0);
    Node { child: Child::start(command, &format!("RabbitMQ node {number}")), mqtt }
}

fn settings(mqtt: u16) -> String {
    let mut text = format!(
        "listeners.tcp.1 = 127.0.0.1:{}\nmqtt.listeners.tcp.1 = 127.0.0.1:{mqtt}\nmqtt.allow_anonymous = true\n\
         cluster_formation.peer_discovery_backend = classic_config\n\
         cluster_formation.randomized_startup_delay_range.min = 0\n\
         cluster_formation.randomized_startup_delay_range.max = 2\n",
        free_port()
    );
    for number in 1..=3 {
        text += &format!("cluster_formation.classic_config.nodes.{number} = lightbots{number}@localhost\n");
    }
    text
}
