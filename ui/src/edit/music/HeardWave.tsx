import { IconPlayerPlayFilled, IconPlayerStopFilled } from '@tabler/icons-react';
import { Group } from '@mantine/core';
import { useEffect, useMemo, useState } from 'react';
import { useStore } from '../../base/store';
import { clockText } from '../../base/time';
import { beatsBetween } from '../../model/beats';
import type { SeenMusic } from '../../music/music';
import { IconButton } from '../../parts/IconButton';
import { useEditing } from '../context';
import { useBeats } from './useBeats';
import { Waveform } from './Waveform';

/** The waveform of the music with its beats, and a button that plays the music. */
export function HeardWave({ music: { hash, lasts_s, peaks } }: { music: SeenMusic }) {
  const { listening, preview } = useEditing();
  const beats = useBeats();
  const drawn = useMemo(() => (beats ? beatsBetween(beats, 0, lasts_s) : []), [beats, lasts_s]);
  const at_s = useStore(listening.at_s);
  const [from_s, setFrom] = useState(0);
  useEffect(() => listening.stop, [listening]);
  const listen = (start_s: number) => {
    preview.stop();
    setFrom(start_s);
    void listening.start(hash, start_s, lasts_s);
  };
  const isHeard = at_s !== null;
  return (
    <>
      <Waveform
        peaks={peaks}
        beats={drawn}
        from_s={0}
        to_s={lasts_s}
        at_s={at_s ?? from_s}
        onSeek={(to_s) => (isHeard ? listen(to_s) : setFrom(to_s))}
      />
      <Group gap="xs">
        <IconButton
          label={isHeard ? 'Stop the music' : 'Hear the music'}
          onClick={() => (isHeard ? listening.stop() : listen(from_s))}
        >
          {isHeard ? <IconPlayerStopFilled size={16} /> : <IconPlayerPlayFilled size={16} />}
        </IconButton>
        {clockText(at_s ?? from_s)} of {clockText(lasts_s)}
      </Group>
    </>
  );
}
