import { describe, expect, it } from 'vitest';
import type { FleetRow } from '../api/types.gen';
import { arranged, type Order } from './fleetOrder';

const row = (id: string, more: Partial<FleetRow> = {}): FleetRow =>
  ({
    id,
    called: null,
    pixel: null,
    battery: null,
    presence: 'active',
    status: 'idle',
    ...more,
  }) as FleetRow;

const ids = (rows: readonly FleetRow[], by: Order, down = false, search = '') =>
  arranged(rows, { by, down, search }).map(({ id }) => id);

describe('the order of robots', () => {
  it('is that of numbers in names', () => {
    expect(ids([row('r10'), row('r9'), row('r1')], 'robot')).toEqual(['r1', 'r9', 'r10']);
    expect(ids([row('b', { called: 'Zoe' }), row('a', { called: 'Ann' })], 'robot', true)).toEqual([
      'b',
      'a',
    ]);
  });

  it('puts spare robots and unknown charges last in either direction', () => {
    const rows = [row('spare'), row('a', { pixel: 2 }), row('b', { pixel: 1 })];
    expect(ids(rows, 'pixel')).toEqual(['b', 'a', 'spare']);
    expect(ids(rows, 'pixel', true)).toEqual(['a', 'b', 'spare']);
    const charged = [row('unknown'), row('full', { battery: 90 }), row('low', { battery: 9 })];
    expect(ids(charged, 'charge')).toEqual(['low', 'full', 'unknown']);
  });

  it('puts troubles first', () => {
    const rows = [row('idle'), row('gone', { presence: 'gone' }), row('lost', { status: 'lost' })];
    expect(ids(rows, 'state')).toEqual(['gone', 'lost', 'idle']);
  });

  it('finds robots by either name', () => {
    const rows = [row('r1', { called: 'Anna' }), row('r2')];
    expect(ids(rows, 'robot', false, ' ANN ')).toEqual(['r1']);
    expect(ids(rows, 'robot', false, 'r2')).toEqual(['r2']);
    expect(ids(rows, 'robot', false, 'x')).toEqual([]);
  });
});
