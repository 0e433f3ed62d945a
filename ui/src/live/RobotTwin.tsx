import { useEffect, useState } from 'react';
import { ROBOT_STATUSES, type Fleet, type Robots } from '../api/types.gen';
import { colourName } from '../base/colour';
import { useSession } from '../session/session';
import { presenceText } from '../session/robotWords';

/** Most robots in the list, because thousands do not help a screen reader. */
const LISTED_MAX = 200;

interface Line {
  key: string;
  text: string;
  status: string;
}

/** The first robots of the fleet as a hidden list, for screen readers and tests. Updated once a second. */
export function RobotTwin() {
  const { live } = useSession();
  const [lines, setLines] = useState<Line[]>([]);
  useEffect(() => {
    const read = () => setLines(describe(live.track.latest(), live.fleet.get()));
    read();
    const timer = setInterval(read, 1000);
    return () => clearInterval(timer);
  }, [live]);
  return (
    <ul className="hidden-text" aria-label="Robots on the floor" data-testid="robots">
      {lines.map((line) => (
        <li key={line.key} data-status={line.status}>
          {line.text}
        </li>
      ))}
    </ul>
  );
}

function describe(robots: Robots | null, fleet: Fleet): Line[] {
  return fleet.rows.slice(0, LISTED_MAX).map((row, i) => {
    const [x, y] = [robots?.x[i] ?? NaN, robots?.y[i] ?? NaN];
    const place = Number.isNaN(x + y)
      ? 'place unknown'
      : `at ${x.toFixed(2)}, ${y.toFixed(2)} metres`;
    const status = ROBOT_STATUSES[robots?.status[i] ?? -1] ?? row.status;
    const pixel = row.pixel === null ? 'stands by' : `pixel ${row.pixel}`;
    const light = colourName(robots?.colour[i] ?? 0);
    const silent = row.presence === 'active' ? '' : `, ${presenceText(row)}`;
    return { key: row.id, status, text: `${pixel}, ${place}, ${light}, ${status}${silent}` };
  });
}
