import { Button, Group, Modal, Table, Text } from '@mantine/core';
import { useStore } from '../../base/store';
import { countText } from '../../base/numbers';
import { arrangeToMusic, withAirTimes } from '../../model/arrangeToMusic';
import { beatsOf } from '../../model/beats';
import { timelineOf } from '../../model/timeline';
import { useEditing, useEditor } from '../context';

interface Props {
  opened: boolean;
  onClose: () => void;
}

/** Proposes air times with which pictures begin with bars, lists the changes, and makes them if the user agrees. */
export function ArrangeDialog({ opened, onClose }: Props) {
  return (
    <Modal opened={opened} onClose={onClose} title="Arrange to music" size="lg">
      <Proposal onClose={onClose} />
    </Modal>
  );
}

function Proposal({ onClose }: { onClose: () => void }) {
  const { editor, settled } = useEditing();
  const show = useEditor((s) => s.show);
  const plan = useStore(settled);
  const beats = beatsOf(show);
  const isPlanned = plan !== null && plan.transitions.length === show.frames.length;
  const changes = beats && isPlanned ? arrangeToMusic(show, timelineOf(show, plan), beats) : [];
  const nameOf = (index: number) => show.frames[index]?.name || `Frame ${index + 1}`;
  const use = () => {
    editor.change('Arrange to music', (now) => withAirTimes(now, changes));
    onClose();
  };
  return (
    <>
      <Text mb="sm">
        {!isPlanned
          ? 'The show is being planned: how long drives take is needed first.'
          : changes.length === 0
            ? 'Every picture begins with a bar already.'
            : `${countText(changes.length, 'air time')} would change, so that each picture begins with the bar nearest to it.`}
      </Text>
      {changes.length > 0 ? (
        <Table.ScrollContainer minWidth={400} maxHeight={360}>
          <Table stickyHeader>
            <Table.Thead>
              <Table.Tr>
                <Table.Th>Frame</Table.Th>
                <Table.Th>Air time</Table.Th>
                <Table.Th>Then begins</Table.Th>
              </Table.Tr>
            </Table.Thead>
            <Table.Tbody>
              {changes.map(({ frame, before_s, after_s, next, bar }) => (
                <Table.Tr key={frame}>
                  <Table.Td>{nameOf(frame)}</Table.Td>
                  <Table.Td>
                    {before_s.toFixed(2)} s → {after_s.toFixed(2)} s
                  </Table.Td>
                  <Table.Td>
                    {next === null ? 'the show ends' : nameOf(next)}, bar {bar}
                  </Table.Td>
                </Table.Tr>
              ))}
            </Table.Tbody>
          </Table>
        </Table.ScrollContainer>
      ) : null}
      <Group justify="flex-end" mt="md">
        <Button variant="default" onClick={onClose}>
          {changes.length > 0 ? 'Not now' : 'Close'}
        </Button>
        {changes.length > 0 ? <Button onClick={use}>Change air times</Button> : null}
      </Group>
    </>
  );
}
