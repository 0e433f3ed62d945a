import { Button, Popover, Stack, Text } from '@mantine/core';
import { IconMusic, IconMusicOff } from '@tabler/icons-react';
import { useEffect, useMemo } from 'react';
import { useStore } from '../base/store';
import { musicOf } from '../model/beats';
import { IconButton } from '../parts/IconButton';
import { NumberField } from '../parts/NumberField';
import { useSession } from '../session/session';
import { createLiveMusic, musicOffset, OFFSET_MAX_MS } from './liveMusic';

/** A button that plays the show's music on this screen, in step with the show; nothing for a show without the file. */
export function MusicButton() {
  const { live } = useSession();
  const hash = useStore(live.opened, (o) => (o.show && musicOf(o.show)?.hash) ?? null);
  const music = useMemo(() => createLiveMusic(live), [live]);
  const isOn = useStore(music.isOn);
  const offset_ms = Number(useStore(musicOffset));
  // Other music needs another press, because browsers let sound begin only in one.
  useEffect(() => music.stop, [music, hash]);
  if (hash === null) return null;
  return (
    <>
      <IconButton
        label={isOn ? 'Music on this screen: on' : 'Hear the music on this screen'}
        name="Music on this screen"
        variant={isOn ? 'light' : 'subtle'}
        color={isOn ? undefined : 'gray'}
        size="lg"
        aria-pressed={isOn}
        onClick={music.toggle}
      >
        {isOn ? <IconMusic size={16} /> : <IconMusicOff size={16} />}
      </IconButton>
      {isOn ? (
        <Popover width={260} withArrow trapFocus>
          <Popover.Target>
            <Button size="compact-xs" variant="subtle" color="gray">
              {offset_ms === 0 ? 'Offset…' : `${offset_ms} ms`}
            </Button>
          </Popover.Target>
          <Popover.Dropdown>
            <Stack gap="xs">
              <NumberField
                label="Play the music earlier by (ms)"
                min={-OFFSET_MAX_MS}
                max={OFFSET_MAX_MS}
                step={10}
                whole
                value={offset_ms}
                onChange={(ms) => musicOffset.set(String(ms))}
              />
              <Text size="xs" c="dimmed">
                Loudspeakers by radio are late, which no browser knows. Set it by ear: more if the
                sound comes after the light.
              </Text>
            </Stack>
          </Popover.Dropdown>
        </Popover>
      ) : null}
    </>
  );
}
