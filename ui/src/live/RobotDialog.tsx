import { Button, Group, Modal, Select, Stack, Switch, TextInput } from '@mantine/core';
import { useMemo, useState } from 'react';
import type { FleetRow } from '../api/types.gen';
import { useStore } from '../base/store';
import { fleetSize, pinPixel, pinsOf } from '../model/commands';
import { changeShow } from '../session/changeShow';
import { useSession } from '../session/session';
import * as words from '../session/robotWords';
import styles from './facts.module.css';
import { Gate } from '../parts/Gate';

/** Details of one robot, and its actions; closed without a `row`. */
export function RobotDialog({ row, onClose }: { row: FleetRow | null; onClose: () => void }) {
  return (
    <Modal opened={row !== null} onClose={onClose} title={row ? `Robot ${words.nameOf(row)}` : ''}>
      {row ? <Details row={row} onClose={onClose} /> : null}
    </Modal>
  );
}

function Details({ row, onClose }: { row: FleetRow; onClose: () => void }) {
  const { ask } = useSession();
  const facts: [string, string][] = [
    ['Name', row.id],
    ['Kind', row.simulated ? 'simulated' : 'real'],
    ['State', words.stateText(row)],
    ['Last seen', words.lastSeenText(row)],
    ['Charge', words.chargeText(row)],
    ['Shows', row.pixel === null ? 'no pixel (spare)' : `pixel ${row.pixel}`],
    ['Firmware', words.firmwareText(row)],
    ['Supports', words.abilitiesText(row)],
    ['Clock', words.clockText(row)],
  ];
  return (
    <Stack>
      <dl className={styles.facts}>
        {facts.map(([name, value]) => [
          <dt key={name}>{name}</dt>,
          <dd key={`${name} value`}>{value}</dd>,
        ])}
      </dl>
      <Gate needs="operator" act="change what is known of robots">
        <NameField key={row.id} row={row} />
        <ListedSwitch row={row} />
        <PinChoice row={row} />
        <Group justify="flex-end">
          <Button
            variant="default"
            onClick={() =>
              void ask({ do: 'forget', robot: row.id }).then((answer) => {
                if (answer.ok) onClose();
              })
            }
          >
            Forget
          </Button>
          <Button
            disabled={!row.abilities.blink || row.presence !== 'active'}
            onClick={() => void ask({ do: 'identify', robot: row.id })}
          >
            Identify
          </Button>
        </Group>
      </Gate>
    </Stack>
  );
}

/** The name that people give the robot, kept on the server. */
function NameField({ row }: { row: FleetRow }) {
  const { ask } = useSession();
  const [text, setText] = useState(row.called ?? '');
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        void ask({ do: 'call', robot: row.id, called: text });
      }}
    >
      <Group align="flex-end" wrap="nowrap">
        <TextInput
          label="What you call it"
          placeholder={words.shortId(row.id)}
          maxLength={40}
          value={text}
          onChange={(event) => setText(event.currentTarget.value)}
          flex={1}
        />
        <Button type="submit" variant="default" disabled={text.trim() === (row.called ?? '')}>
          Save name
        </Button>
      </Group>
    </form>
  );
}

/** A switch for whether this robot is listed; nothing unless only listed robots take part. */
function ListedSwitch({ row }: { row: FleetRow }) {
  const { ask, live } = useSession();
  if (!useStore(live.fleet, (fleet) => fleet.only_listed)) return null;
  return (
    <Switch
      label="It is on the list of robots that take part"
      checked={row.admitted}
      onChange={(event) =>
        void ask({ do: 'list', robots: [row.id], listed: event.currentTarget.checked })
      }
    />
  );
}

/** Chooses the pixel that is pinned to this robot, in all frames of the show; nothing without pixels. */
function PinChoice({ row }: { row: FleetRow }) {
  const session = useSession();
  const show = useStore(session.live.opened, (o) => o.show);
  const pins = useMemo(() => (show ? pinsOf(show) : new Map<number, string>()), [show]);
  if (!show || fleetSize(show) === 0) return null;
  const mine = [...pins].find(([, robot]) => robot === row.id)?.[0];
  const ids = [...new Set(show.frames.flatMap((f) => f.pixels.map((p) => p.id)))];
  const options = ids
    .sort((a, b) => a - b)
    .map((id) => {
      const other = pins.get(id);
      const taken = other && other !== row.id ? `, pinned to ${words.shortId(other)}` : '';
      return { value: String(id), label: `Pixel ${id}${taken}` };
    });
  const pin = (value: string | null) => {
    const pixel = value ? Number(value) : mine;
    if (pixel === undefined) return;
    const robot = value ? row.id : null;
    void changeShow(session, 'Pin', (now) => pinPixel(now, pixel, robot));
  };
  return (
    <Select
      label="Pinned to pixel (all frames)"
      searchable
      allowDeselect={false}
      limit={200}
      data={[{ value: '', label: 'None' }, ...options]}
      value={mine === undefined ? '' : String(mine)}
      onChange={pin}
    />
  );
}
