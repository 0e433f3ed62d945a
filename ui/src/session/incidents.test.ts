import { describe, expect, it } from 'vitest';
import type { Fleet, Incident, Robots } from '../api/types.gen';
import { calloutsOf, earlier, isHeard, unread } from './incidents';

const incident = (id: number, more: Partial<Incident> = {}): Incident => ({
  id,
  time_ms: id,
  tone: 'look',
  title: '',
  done: '',
  advice: '',
  robots: [],
  count: 0,
  wants_to_join: false,
  over: false,
  read: false,
  ...more,
});

const rows = ['a', 'b', 'c'].map((id) => ({ id }));
const fleet = { revision: 1, rows } as unknown as Fleet;
const robots = { x: [1, 2, NaN], y: [3, 4, NaN] } as unknown as Robots;

describe('incidents', () => {
  it('puts the newest unread one first', () => {
    const list = [incident(1), incident(2, { read: true }), incident(3)];
    expect(unread(list).map((one) => one.id)).toEqual([3, 1]);
    expect(earlier(list).map((one) => one.id)).toEqual([2]);
  });

  it('makes a sound once, and only for what has to be looked at', () => {
    expect(isHeard(incident(4), 3)).toBe(true);
    expect(isHeard(incident(3), 3)).toBe(false);
    expect(isHeard(incident(4, { tone: 'information' }), 3)).toBe(false);
    expect(isHeard(incident(4, { read: true }), 3)).toBe(false);
  });

  it('points at robots whose place is known', () => {
    const list = [incident(1, { robots: ['b', 'c'] }), incident(2, { robots: ['a'], over: true })];
    expect(calloutsOf(list, fleet, robots)).toEqual([{ name: 'b', x: 2, y: 4 }]);
    expect(calloutsOf(list, fleet, null)).toEqual([]);
  });
});
