import { Button, Group, SegmentedControl, Stack, Text } from '@mantine/core';
import { useStore } from '../base/store';
import { fleetSize, setFleetSize, setShow, setSpares, sparesOf } from '../model/commands';
import { limitOf, LIMITS_USUAL, setLimit, type LimitName } from '../model/limits';
import { LengthInput } from '../parts/LengthInput';
import { NumberField } from '../parts/NumberField';
import { robotsToFit } from '../session/fitness';
import { useSession } from '../session/session';
import { useEditing, useEditor } from './context';

/** Most pixels per frame, and most spare robots, that can be typed here; larger shows come from files. */
const FLEET_MAX = 2000;

const NUMBERS: [LimitName, string, number, number, number][] = [
  ['speed_mps', 'Speed (m/s)', 0.01, 10, 0.01],
  ['accel_mps2', 'Acceleration (m/s²)', 0.01, 100, 0.1],
  ['turn_radps', 'Turn rate (rad/s)', 0.1, 100, 0.1],
];

/** Number, size and limits of the show's robots. */
export function RobotsSection() {
  const { editor, color } = useEditing();
  const { live, fitting } = useSession();
  const show = useEditor((s) => s.show);
  const size = fleetSize(show);
  const rows = useStore(live.fleet, (fleet) => fleet.rows);
  const here = robotsToFit(show, null, rows);
  const resize = (count: number) =>
    editor.change('Robots', (now) => setFleetSize(now, count, color.get()));
  const limit = (name: LimitName, value: number) =>
    editor.change('Robot limits', (now) => setLimit(now, name, value));
  return (
    <Stack gap="xs" component="section" aria-label="Robots">
      <Text size="sm" fw={600}>
        Robots
      </Text>
      <Group align="end" gap="xs" wrap="nowrap">
        <NumberField
          label="Number of robots"
          whole
          min={1}
          max={FLEET_MAX}
          value={size}
          onChange={resize}
        />
        {here !== null ? (
          <Button size="xs" variant="default" onClick={() => fitting.set(here)}>
            Fit to the {here} here…
          </Button>
        ) : null}
      </Group>
      <NumberField
        label="Spare robots"
        description="They wait where they start, and take over the pixels of robots that fail."
        whole
        min={0}
        max={FLEET_MAX}
        value={sparesOf(show)}
        onChange={(count) => editor.change('Spare robots', (now) => setSpares(now, count))}
      />
      <Stack gap={4}>
        <Text size="xs">Robot assignment</Text>
        <SegmentedControl
          aria-label="Robot assignment"
          size="xs"
          value={show.identity}
          onChange={(value) =>
            editor.change('Identity', (now) => setShow(now, { identity: value as 'any' | 'fixed' }))
          }
          data={[
            { value: 'any', label: 'Nearest robot' },
            { value: 'fixed', label: 'Fixed robot per pixel' },
          ]}
        />
      </Stack>
      <details>
        <summary>Robot size and speed</summary>
        <Stack gap="xs" pt="xs">
          <LengthInput
            label="Radius"
            min={0.005}
            max={1}
            value={limitOf(show.stage, 'radius_m')}
            onChange={(m) => limit('radius_m', m)}
          />
          {NUMBERS.map(([name, label, min, max, step]) => (
            <NumberField
              key={name}
              label={label}
              description={`Elisa-3: ${LIMITS_USUAL[name]}`}
              min={min}
              max={max}
              step={step}
              digits={3}
              value={limitOf(show.stage, name)}
              onChange={(value) => limit(name, value)}
            />
          ))}
        </Stack>
      </details>
    </Stack>
  );
}
