import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { backoff_ms } from './backoff';
import { createLink, type LinkState, type SocketLike } from './socket';

class FakeSocket implements SocketLike {
  binaryType = 'blob';
  sent: string[] = [];
  onopen: (() => void) | null = null;
  onclose: (() => void) | null = null;
  onmessage: ((event: { data: unknown }) => void) | null = null;
  send(text: string) {
    this.sent.push(text);
  }
  close() {
    this.onclose?.();
  }
}

function setup(isHidden = () => false) {
  const sockets: FakeSocket[] = [];
  const states: LinkState[] = [];
  const messages: string[] = [];
  const link = createLink({
    open: () => {
      const socket = new FakeSocket();
      sockets.push(socket);
      return socket;
    },
    onMessage: (m) => messages.push(m.type),
    onRobots: (robots) => messages.push(`robots ${robots.x.length}`),
    onLink: (s) => states.push(s),
    isHidden,
    random: () => 0.5,
  });
  const socket = (n: number) => sockets[n] as FakeSocket;
  return { sockets, socket, states, messages, link };
}

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

test('waits longer each time, and never for ever', () => {
  expect([0, 1, 2, 9, 1000].map((n) => backoff_ms(n, 0.5))).toEqual([250, 500, 1000, 5000, 5000]);
});

test('comes back by itself, and starts afresh once it was back', () => {
  const { sockets, socket, states } = setup();
  socket(0).onopen?.();
  socket(0).onclose?.();
  vi.advanceTimersByTime(250);
  socket(1).onclose?.();
  vi.advanceTimersByTime(499);
  expect(sockets).toHaveLength(2);
  vi.advanceTimersByTime(1);
  socket(2).onopen?.();
  expect(states).toEqual(['connecting', 'open', 'lost', 'lost', 'open']);
});

test('an answer finds its question', async () => {
  const { socket, link, messages } = setup();
  socket(0).onopen?.();
  const first = link.operate({ do: 'pause' });
  const second = link.operate({ do: 'refresh' });
  socket(0).onmessage?.({ data: '{"type":"answer","id":2,"ok":true,"error":null,"choice":null}' });
  socket(0).onmessage?.({ data: '{"type":"answer","id":1,"ok":false,"error":"no","choice":null}' });
  expect((await first).error).toBe('no');
  expect((await second).ok).toBe(true);
  expect(messages).toEqual([]);
});

test('junk is dropped, and questions do not wait for ever', async () => {
  const { socket, link, messages } = setup();
  expect((await link.operate({ do: 'pause' })).ok).toBe(false);
  socket(0).onopen?.();
  for (const data of ['', '{', 'null', '7', '{"type":5}', new ArrayBuffer(3)])
    socket(0).onmessage?.({ data });
  socket(0).onmessage?.({ data: '{"type":"log","time_ms":0,"level":"info","text":"x"}' });
  expect(messages).toEqual(['log']);
  const silent = link.operate({ do: 'pause' });
  vi.advanceTimersByTime(10_000);
  expect((await silent).ok).toBe(false);
  const cut = link.operate({ do: 'pause' });
  socket(0).onclose?.();
  expect((await cut).error).toContain('broke');
});

test('robots come as bytes, and the server is told once a state has been dealt with', () => {
  const { socket, messages } = setup();
  socket(0).onopen?.();
  expect(socket(0).binaryType).toBe('arraybuffer');
  const bytes = new Uint8Array(4 + 29);
  bytes[0] = 1;
  socket(0).onmessage?.({ data: bytes.buffer });
  socket(0).onmessage?.({ data: bytes.buffer.slice(1) });
  expect([messages, socket(0).sent]).toEqual([['robots 1'], []]);
  socket(0).onmessage?.({ data: '{"type":"state"}' });
  expect(messages).toEqual(['robots 1', 'state']);
  expect(socket(0).sent).toEqual(['{"type":"took"}']);
});

test('a hidden page takes states slowly, and all at once when it is seen again', () => {
  let hidden = true;
  const { socket, link } = setup(() => hidden);
  socket(0).onopen?.();
  const state = () => socket(0).onmessage?.({ data: '{"type":"state"}' });
  state();
  state();
  vi.advanceTimersByTime(999);
  expect(socket(0).sent).toEqual([]);
  vi.advanceTimersByTime(1);
  expect(socket(0).sent).toHaveLength(2);
  state();
  hidden = false;
  link.wake();
  expect(socket(0).sent).toHaveLength(3);
  state();
  expect(socket(0).sent).toHaveLength(4);
  vi.advanceTimersByTime(5000);
  expect(socket(0).sent).toHaveLength(4);
});

test('what a broken connection held back is not said to the next one', () => {
  const { socket } = setup(() => true);
  socket(0).onopen?.();
  socket(0).onmessage?.({ data: '{"type":"state"}' });
  socket(0).onclose?.();
  vi.advanceTimersByTime(250);
  socket(1).onopen?.();
  vi.advanceTimersByTime(5000);
  expect(socket(1).sent).toEqual([]);
});
