import { ActionIcon, Text, Tooltip } from '@mantine/core';
import { IconBulb, IconX } from '@tabler/icons-react';
import { memo } from 'react';
import type { FleetRow } from '../api/types.gen';
import { useStore } from '../base/store';
import { ageText } from '../base/time';
import { useSession, type Session } from '../shell/session';

/** Rows shown; beyond it nobody reads a table. */
const ROWS_MAX = 300;

/** By pixel, those who stand by last. */
const byPixel = (a: FleetRow, b: FleetRow) =>
  (a.pixel ?? Infinity) - (b.pixel ?? Infinity) || a.id.localeCompare(b.id);

/** Which robot shows which pixel, and how it is. */
export function FleetTable() {
  const { live, ask } = useSession();
  const rows = useStore(live.fleet, (fleet) => fleet.rows);
  if (rows.length === 0)
    return (
      <Text c="dimmed" size="sm" p="md">
        Robots appear here when they introduce themselves.
      </Text>
    );
  const shown = [...rows].sort(byPixel).slice(0, ROWS_MAX);
  return (
    <>
      <table className="fleet-table">
        <thead>
          <tr>
            <th scope="col">Pixel</th>
            <th scope="col">Robot</th>
            <th scope="col">State</th>
            <th scope="col">Charge</th>
            <th scope="col">
              <span className="hidden-text">Actions</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {shown.map((row) => (
            <Row key={row.id} row={row} ask={ask} />
          ))}
        </tbody>
      </table>
      {rows.length > ROWS_MAX ? (
        <Text c="dimmed" size="sm" p="sm">
          and {rows.length - ROWS_MAX} more
        </Text>
      ) : null}
    </>
  );
}

interface RowProps {
  row: FleetRow;
  ask: Session['ask'];
}

const detailsOf = (row: FleetRow) =>
  [
    row.id,
    row.firmware ?? 'original protocol',
    `heard ${ageText(row.age_s)}${row.age_s < 1.5 ? '' : ' ago'}`,
    row.clock_us === null
      ? 'clock not synchronised'
      : `clock ± ${(row.clock_us / 1000).toFixed(1)} ms`,
  ].join(' · ');

/** Everything of a row that is shown. The table comes twice a second, and hardly a row of it says anything new. */
const shownOf = (row: FleetRow) =>
  [
    detailsOf(row),
    row.pixel,
    row.status,
    row.presence,
    ageText(row.age_s),
    row.battery,
    row.abilities.blink,
  ].join('|');

const Row = memo(
  RobotRow,
  (before, after) => before.ask === after.ask && shownOf(before.row) === shownOf(after.row),
);

function RobotRow({ row, ask }: RowProps) {
  const details = detailsOf(row);
  return (
    <tr data-presence={row.presence}>
      <td>{row.pixel ?? <span className="quiet">–</span>}</td>
      <td className="mono">
        <Tooltip label={details} multiline maw={320}>
          <span>{row.id.slice(0, 8)}</span>
        </Tooltip>
      </td>
      <td>{row.presence === 'active' ? row.status : `${row.presence}, ${ageText(row.age_s)}`}</td>
      <td>{row.battery === null ? <span className="quiet">–</span> : `${row.battery} %`}</td>
      <td style={{ textAlign: 'right', padding: '1px 4px' }}>
        {row.presence === 'active' ? (
          <Tooltip label="Let it blink">
            <ActionIcon
              variant="subtle"
              color="gray"
              size="sm"
              disabled={!row.abilities.blink}
              aria-label={`Let robot ${row.id.slice(0, 8)} blink`}
              onClick={() => void ask({ do: 'identify', robot: row.id })}
            >
              <IconBulb size={15} />
            </ActionIcon>
          </Tooltip>
        ) : (
          <Tooltip label="Forget it until it reports again">
            <ActionIcon
              variant="subtle"
              color="gray"
              size="sm"
              aria-label={`Forget robot ${row.id.slice(0, 8)}`}
              onClick={() => void ask({ do: 'forget', robot: row.id })}
            >
              <IconX size={15} />
            </ActionIcon>
          </Tooltip>
        )}
      </td>
    </tr>
  );
}
