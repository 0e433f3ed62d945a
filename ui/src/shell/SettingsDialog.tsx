import {
  Button,
  Group,
  Modal,
  Select,
  SegmentedControl,
  Stack,
  Switch,
  Text,
  useMantineColorScheme,
} from '@mantine/core';
import { useStore } from '../base/store';
import { isUnit, UNITS, type Unit } from '../base/units';
import { Gate } from '../parts/Gate';
import { BrokerSection } from './BrokerSection';
import { setSound, useSound } from '../session/alarm';
import { setUnit, useUnit } from '../session/preferences';
import { useSession } from '../session/session';
import { goTo } from '../session/address';
import { SignedInSection } from './SignedInSection';

interface Props {
  opened: boolean;
  onClose: () => void;
  /** Opens the keyboard map in place of the settings. */
  onKeys: () => void;
}

/** A dialog with the settings of this screen and of the server. Those of a show are in the editor. */
export function SettingsDialog({ opened, onClose, onKeys }: Props) {
  const { live } = useSession();
  const version = useStore(live.hello, (hello) => hello?.version);
  return (
    <Modal opened={opened} onClose={onClose} title="Settings">
      <Stack>
        <AppearanceAndUnits />
        <Gate needs="operator" act="change robots and broker">
          <NewRobots />
          <BrokerSection />
        </Gate>
        <SignedInSection />
        <Group justify="space-between">
          <Button size="compact-sm" variant="subtle" color="gray" onClick={onKeys}>
            Keyboard map
          </Button>
          <Button
            size="compact-sm"
            variant="subtle"
            color="gray"
            onClick={() => {
              onClose();
              goTo('edit');
            }}
          >
            Edit floor and robots…
          </Button>
        </Group>
        <Text size="xs" c="dimmed">
          LightBots {version ?? ''}
        </Text>
      </Stack>
    </Modal>
  );
}

function AppearanceAndUnits() {
  const { colorScheme, setColorScheme } = useMantineColorScheme();
  const unit = useUnit();
  const sound = useSound();
  return (
    <>
      <Stack gap={4}>
        <Text size="sm" fw={500}>
          Appearance
        </Text>
        <SegmentedControl
          aria-label="Appearance"
          value={colorScheme}
          onChange={(value) => setColorScheme(value as 'dark' | 'light' | 'auto')}
          data={[
            { value: 'dark', label: 'Dark' },
            { value: 'light', label: 'Light' },
            { value: 'auto', label: 'System' },
          ]}
        />
      </Stack>
      <Switch
        label="A sound when something goes wrong"
        checked={sound}
        onChange={(event) => setSound(event.currentTarget.checked)}
      />
      <Select
        label="Units"
        allowDeselect={false}
        data={(Object.keys(UNITS) as Unit[]).map((u) => ({ value: u, label: UNITS[u].name }))}
        value={unit}
        onChange={(value) => {
          if (isUnit(value)) setUnit(value);
        }}
      />
    </>
  );
}

/** A switch for whether new robots must be let in. It holds for the server, and so for all screens. */
function NewRobots() {
  const { ask, live } = useSession();
  const only = useStore(live.fleet, (fleet) => fleet.only_listed);
  return (
    <Switch
      label="Ask before new robots take part"
      description="On: the robots that are here now are listed. Another one has to be let in, and is driven around until then."
      checked={only}
      onChange={(event) => void ask({ do: 'only_listed', on: event.currentTarget.checked })}
    />
  );
}
