import { Button, Group, Text, TextInput } from '@mantine/core';
import { IconChevronDown, IconChevronUp } from '@tabler/icons-react';
import { useMemo, useRef, useState } from 'react';
import { useStore } from '../base/store';
import { pinsOf } from '../model/commands';
import { useKeys } from '../parts/useKeys';
import { useSession } from '../session/session';
import { arranged, type Arrangement, type Order } from './fleetOrder';
import { FleetLine } from './FleetLine';
import { PlacesButton } from './PlacesButton';
import { PreflightButton } from './PreflightButton';
import { RobotDialog } from './RobotDialog';
import styles from './FleetTable.module.css';

/** Most rows that the table shows; the number of further ones is written below it. */
const ROWS_MAX = 300;

/** Title and sort key of the columns that are always shown; FleetLine draws the cells in the same order. */
const COLUMNS = [
  ['Pixel', 'pixel'],
  ['Robot', 'robot'],
  ['State', 'state'],
  ['Charge', 'charge'],
] as const;
const MORE_COLUMNS = ['Last seen', 'Firmware', 'Supports', 'Clock'] as const;

/** The fleet as a table with a search: pixel, name, state and charge of each robot, and more if `wide`. */
export function FleetTable(props: { wide: boolean; onWide: (wide: boolean) => void }) {
  const { wide } = props;
  const { live, ask } = useSession();
  const rows = useStore(live.fleet, (fleet) => fleet.rows);
  const show = useStore(live.opened, (o) => o.show);
  const pinned = useMemo(() => new Set(show ? pinsOf(show).values() : []), [show]);
  const [chosen, setChosen] = useState<string | null>(null);
  const [order, setOrder] = useState<Arrangement>({ by: 'pixel', down: false, search: '' });
  const search = useRef<HTMLInputElement>(null);
  useKeys([['/', () => search.current?.focus()]]);
  if (rows.length === 0)
    return (
      <Text c="dimmed" size="sm" p="md">
        Robots appear here when they introduce themselves. Switch them on, or press Refresh below
        the floor.
      </Text>
    );
  const found = arranged(rows, order);
  const shown = found.slice(0, ROWS_MAX);
  return (
    <>
      <Group justify="space-between" px="xs" pt={6} wrap="nowrap">
        <TextInput
          ref={search}
          size="xs"
          type="search"
          aria-label="Find a robot by its name (/)"
          placeholder="Find a robot"
          value={order.search}
          onChange={(event) => setOrder({ ...order, search: event.currentTarget.value })}
        />
        <Button
          size="compact-xs"
          style={{ flex: 'none' }}
          variant={wide ? 'light' : 'subtle'}
          color="gray"
          aria-expanded={wide}
          onClick={() => props.onWide(!wide)}
        >
          Details
        </Button>
      </Group>
      <Group gap={4} px={6} pt={4}>
        <PlacesButton />
        <PreflightButton />
      </Group>
      <table className={styles.table}>
        <thead>
          <tr>
            {COLUMNS.map(([title, by]) => (
              <Title key={title} title={title} by={by} order={order} onOrder={setOrder} />
            ))}
            {(wide ? MORE_COLUMNS : []).map((title) => (
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
      {shown.length === 0 ? (
        <Text c="dimmed" size="sm" p="sm">
          No robot is called so.
        </Text>
      ) : null}
      {found.length > ROWS_MAX ? (
        <Text c="dimmed" size="sm" p="sm">
          and {found.length - ROWS_MAX} more
        </Text>
      ) : null}
      <RobotDialog
        row={rows.find((row) => row.id === chosen) ?? null}
        onClose={() => setChosen(null)}
      />
    </>
  );
}

/** The title of a column; a press sorts by it, a press on the sorted column turns the order round. */
function Title(props: {
  title: string;
  by: Order;
  order: Arrangement;
  onOrder: (order: Arrangement) => void;
}) {
  const { title, by, order, onOrder } = props;
  const mine = order.by === by;
  const sort = !mine ? undefined : order.down ? 'descending' : 'ascending';
  const Arrow = order.down ? IconChevronDown : IconChevronUp;
  return (
    <th scope="col" aria-sort={sort}>
      <button type="button" onClick={() => onOrder({ ...order, by, down: mine && !order.down })}>
        {title}
        {mine ? <Arrow size={12} aria-hidden /> : null}
      </button>
    </th>
  );
}
