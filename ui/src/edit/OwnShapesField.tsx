import { Button, CloseButton, Group, Stack, Text, TextInput } from '@mantine/core';
import { useState } from 'react';
import { useStore } from '../base/store';
import { draftOf, sourcesOf } from '../make/draft';
import type { Making } from '../make/making';
import { createOwnShapes } from '../make/ownShapes';
import { IDLE_PEN } from '../make/penState';
import styles from './Make.module.css';

function storage(): Storage | null {
  try {
    return localStorage;
  } catch {
    return null;
  }
}

/** The own shapes of this browser, for every show. */
const shapes = createOwnShapes(storage());

/** Longest name of an own shape, characters. */
const NAME_MAX = 60;

/** Own shapes: a click loads one into the Make panel, Save keeps under a name what the panel makes now. */
export function OwnShapesField({ making }: { making: Making }) {
  const list = useStore(shapes.list);
  const source = sourcesOf(useStore(making.draft))[0] ?? null;
  const [name, setName] = useState('');
  const [problem, setProblem] = useState<string | null>(null);
  const wanted = name.trim();
  const save = () => {
    if (!source || wanted === '') return;
    const why = shapes.save(wanted, source);
    setProblem(why);
    if (why === null) setName('');
  };
  return (
    <Stack gap="xs" component="section" aria-label="Own shapes">
      <Text size="xs" fw={600}>
        Own shapes
      </Text>
      {list.length === 0 ? (
        <Text size="xs" c="dimmed">
          Give what is made now a name, and use it in any show on this browser.
        </Text>
      ) : (
        <Group gap={6}>
          {list.map((shape) => (
            <span key={shape.name} className={styles.own}>
              <Button
                size="compact-xs"
                variant="default"
                onClick={() => {
                  making.pen.set(IDLE_PEN);
                  making.change(draftOf(shape.source));
                }}
              >
                {shape.name}
              </Button>
              <CloseButton
                size="xs"
                aria-label={`Remove own shape ${shape.name}`}
                onClick={() => shapes.remove(shape.name)}
              />
            </span>
          ))}
        </Group>
      )}
      <Group gap="xs" align="end" wrap="nowrap">
        <TextInput
          style={{ flex: 1 }}
          size="xs"
          label="Keep this as"
          maxLength={NAME_MAX}
          value={name}
          error={problem}
          onChange={(event) => {
            setName(event.currentTarget.value);
            setProblem(null);
          }}
          onKeyDown={(event) => {
            if (event.key !== 'Enter') return;
            // Enter would submit the form of the Make panel, which uses the frame.
            event.preventDefault();
            save();
          }}
        />
        <Button size="xs" variant="default" disabled={!source || wanted === ''} onClick={save}>
          {list.some((shape) => shape.name === wanted) ? 'Replace' : 'Save'}
        </Button>
      </Group>
    </Stack>
  );
}
