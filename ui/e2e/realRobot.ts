import { connect } from 'node:net';
import type { Server } from './harness';

const text = (value: string) => {
  const bytes = Buffer.from(value);
  return Buffer.concat([Buffer.from([bytes.length >> 8, bytes.length & 255]), bytes]);
};
const packet = (kind: number, ...parts: Buffer[]) => {
  const body = Buffer.concat(parts);
  return Buffer.concat([Buffer.from([kind, body.length]), body]);
};

/**
 * Connects to the server's embedded broker as a robot of the original protocol does, and sends its first message, with
 * its place in stage metres. The robot counts as real. Answers what disconnects it.
 */
export async function introduceRealRobot(server: Server, name: string, x: number, y: number) {
  const settings = await fetch(`${server.url}/api/broker`);
  const { embedded } = (await settings.json()) as { embedded: string };
  const { hostname, port } = new URL(embedded.replace('mqtt:', 'http:'));
  const socket = connect(Number(port), hostname);
  const [user, password] = [text('default'), text('default')];
  const about = Buffer.from([4, 0xc2, 0, 60]);
  socket.write(packet(0x10, text('MQTT'), about, text(`LightBot/${name}`), user, password));
  // The broker answers that it accepts the connection.
  await new Promise((resolve, reject) => socket.once('data', resolve).once('error', reject));
  socket.write(packet(0x30, text('T/LightBot/UUID'), Buffer.from(`${name} ${x} ${y}`)));
  return () => socket.destroy();
}
