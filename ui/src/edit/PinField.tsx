import { Group, Select } from '@mantine/core';
import { IconBulb } from '@tabler/icons-react';
import { useStore } from '../base/store';
import { IconButton } from '../parts/IconButton';
import { shortId } from '../session/robotWords';
import { pinPixel } from '../model/commands';
import type { Pixel } from '../model/show';
import { useSession } from '../session/session';
import { useEditing } from './context';

/** The robot that is pinned to a pixel in all frames. */
export function PinField({ pixel }: { pixel: Pixel }) {
  const { editor } = useEditing();
  const { live, ask } = useSession();
  const rows = useStore(live.fleet, (fleet) => fleet.rows);
  const here = rows.map((row) => {
    const shows = row.pixel === null ? '' : ` (shows ${row.pixel})`;
    const silent = row.presence === 'active' ? '' : ', silent';
    return { value: row.id, label: `${shortId(row.id)}${shows}${silent}` };
  });
  const away =
    pixel.robot !== null && rows.every((row) => row.id !== pixel.robot)
      ? [{ value: pixel.robot, label: `${shortId(pixel.robot)}, not here` }]
      : [];
  const pinned = rows.find((row) => row.id === pixel.robot);
  const blinks = pinned?.presence === 'active' && pinned.abilities.blink;
  return (
    <Group gap="xs" align="end" wrap="nowrap">
      <Select
        size="xs"
        style={{ flex: 1 }}
        label="Pinned robot"
        nothingFoundMessage="No robot found"
        searchable
        allowDeselect={false}
        limit={200}
        data={[{ value: '', label: 'None' }, ...away, ...here]}
        value={pixel.robot ?? ''}
        onChange={(robot) =>
          editor.change('Pin', (show) => pinPixel(show, pixel.id, robot || null))
        }
      />
      <IconButton
        label="Identify robot"
        variant="default"
        size={30}
        disabled={!blinks}
        onClick={() => pinned && void ask({ do: 'identify', robot: pinned.id })}
      >
        <IconBulb size={16} />
      </IconButton>
    </Group>
  );
}
