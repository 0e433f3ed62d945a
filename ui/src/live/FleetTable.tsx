import { Button, Group, Text } from '@mantine/core';
import { useMemo, useState } from 'react';
import type { FleetRow } from '../api/types.gen';
import { useStore } from '../base/store';
import { pinsOf } from '../model/commands';
import { useSession } from '../session/session';
import { FleetLine } from './FleetLine';
import { RobotDialog } from './RobotDialog';
import styles from './FleetTable.module.css';

/** Most rows that the table shows; longer tables are not read. */
const ROWS_MAX = 300;

/** By pixel; spare robots last. */
const byPixel = (a: FleetRow, b: FleetRow) =>
  (a.pixel ?? Infinity) - (b.pixel ?? Infinity) || a.id.localeCompare(b.id);

/** Titles; the cells are in FleetLine. */
const COLUMNS = ['Pixel', 'Robot', 'State', 'Charge'] as const;
const MORE_COLUMNS = ['Last seen', 'Firmware', 'Supports', 'Clock'] as const;

/** The fleet: pixel and state of each robot. */
export function FleetTable(props: { wide: boolean; onWide: (wide: boolean) => void }) {
  const { wide } = props;
  const { live, ask } = useSession();
  const rows = useStore(live.fleet, (fleet) => fleet.rows);
  const show = useStore(live.opened, (o) => o.show);
  const pinned = useMemo(() => new Set(show ? pinsOf(show).values() : []), [show]);
  const [chosen, setChosen] = useState<string | null>(null);
  if (rows.length === 0)
    return (
      <Text c="dimmed" size="sm" p="md">
        Robots appear here when they introduce themselves. Switch them on, or press Refresh below
        the floor.
      </Text>
    );
  const shown = [...rows].sort(byPixel).slice(0, ROWS_MAX);
  return (
    <>
      <Group justify="flex-end" px="xs" pt={6}>
        <Button
          size="compact-xs"
          variant={wide ? 'light' : 'subtle'}
          color="gray"
          aria-expanded={wide}
          onClick={() => props.onWide(!wide)}
        >
          Details
        </Button>
      </Group>
      <table className={styles.table}>
        <thead>
          <tr>
            {[...COLUMNS, ...(wide ? MORE_COLUMNS : [])].map((title) => (
              <th key={title} scope="col">
                {title}
              </th>
            ))}
            <th scope="col">
              <span className="hidden-text">Actions</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {shown.map((row) => (
            <FleetLine
              key={row.id}
              row={row}
              wide={wide}
              pinned={pinned.has(row.id)}
              ask={ask}
              choose={setChosen}
            />
          ))}
        </tbody>
      </table>
      {rows.length > ROWS_MAX ? (
        <Text c="dimmed" size="sm" p="sm">
          and {rows.length - ROWS_MAX} more
        </Text>
      ) : null}
      <RobotDialog
        row={rows.find((row) => row.id === chosen) ?? null}
        onClose={() => setChosen(null)}
      />
    </>
  );
}
