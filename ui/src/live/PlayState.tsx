import { Tooltip } from '@mantine/core';
import { useStore } from '../base/store';
import { clockText } from '../base/time';
import { useSession } from '../shell/session';
import { phaseText } from './actions';

/** Frame x of y, who is still on the way, time left. */
export function PlayState() {
  const { live } = useSession();
  const playback = useStore(live.playback);
  const rows = useStore(live.fleet, (fleet) => fleet.rows);
  const names = playback.late.map((id) => {
    const pixel = rows.find((row) => row.id === id)?.pixel;
    return pixel === null || pixel === undefined ? id.slice(0, 8) : `pixel ${pixel}`;
  });
  return (
    <div className="play-state">
      <span role="status" data-testid="phase" data-phase={playback.phase}>
        {phaseText(playback)}
      </span>
      {names.length > 0 ? (
        <Tooltip label={`On the way: ${names.join(', ')}`}>
          <span className="quiet">{names.length === 20 ? '20+' : names.length} on the way</span>
        </Tooltip>
      ) : null}
      {playback.left_s === null ? null : (
        <span className="quiet">
          −{clockText(playback.left_s)}
          <span className="hidden-text"> left</span>
        </span>
      )}
    </div>
  );
}
