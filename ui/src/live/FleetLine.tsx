import { IconBulb, IconDots, IconPinFilled } from '@tabler/icons-react';
import { memo } from 'react';
import type { FleetRow } from '../api/types.gen';
import { Gate } from '../parts/Gate';
import { IconButton } from '../parts/IconButton';
import type { Session } from '../session/session';
import { canDrive, CHARGE_LOW } from '../session/checklist';
import * as words from '../session/robotWords';
import styles from './FleetTable.module.css';

interface Props {
  row: FleetRow;
  wide: boolean;
  pinned: boolean;
  ask: Session['ask'];
  /** Opens the details of the robot. */
  choose: (id: string) => void;
}

/** The shown values of a row as one text, because most rows of a new table are unchanged. A line is drawn again only if
 * this text changes: every shown value must be in it. */
const shownOf = ({ row, wide, pinned }: Props) =>
  [
    row.called,
    row.admitted,
    row.pixel,
    words.stateText(row),
    words.chargeText(row),
    wide && [words.lastSeenText(row), words.clockText(row)],
    wide && [words.firmwareText(row), words.abilitiesText(row)],
    row.abilities.blink,
    row.presence,
    wide,
    pinned,
  ].join('|');

/** One robot of the fleet table. */
export const FleetLine = memo(
  Line,
  (before, after) =>
    before.ask === after.ask &&
    before.choose === after.choose &&
    shownOf(before) === shownOf(after),
);

function Line({ row, wide, pinned, ask, choose }: Props) {
  const name = words.nameOf(row);
  const low = row.battery !== null && row.battery < CHARGE_LOW;
  return (
    <tr data-presence={row.presence}>
      <td>
        {row.pixel ?? <span className="quiet">–</span>}
        {pinned ? <IconPinFilled size={12} role="img" aria-label="pinned" /> : null}
      </td>
      <td className={row.called === null ? 'mono' : styles.called}>
        {name}
        {row.admitted ? null : <span className="quiet"> not listed</span>}
      </td>
      <td data-low={!canDrive(row) || undefined}>{words.stateText(row)}</td>
      <td data-low={low || undefined}>
        {words.chargeText(row)}
        {low ? <span className="hidden-text"> low</span> : null}
      </td>
      {wide ? (
        <>
          <td>{words.lastSeenText(row)}</td>
          <td>{words.firmwareText(row)}</td>
          <td>{words.abilitiesText(row)}</td>
          <td>{words.clockText(row)}</td>
        </>
      ) : null}
      <td className={styles.actions}>
        <Gate needs="operator" act="have robots blink">
          <IconButton
            label="Identify"
            name={`Identify robot ${name}`}
            size="sm"
            disabled={!row.abilities.blink || row.presence !== 'active'}
            onClick={() => void ask({ do: 'identify', robot: row.id })}
          >
            <IconBulb size={15} />
          </IconButton>
        </Gate>
        <IconButton
          label="Robot details"
          name={`Details of robot ${name}`}
          size="sm"
          onClick={() => choose(row.id)}
        >
          <IconDots size={15} />
        </IconButton>
      </td>
    </tr>
  );
}
