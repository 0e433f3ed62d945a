import { ActionIcon, Tooltip } from '@mantine/core';
import { IconBulb, IconDots, IconPinFilled } from '@tabler/icons-react';
import type { FleetRow } from '../api/types.gen';
import { CHARGE_LOW } from './checklist';
import * as words from './robotWords';

interface Props {
  row: FleetRow;
  wide: boolean;
  pinned: boolean;
  identify: () => void;
  /** Shows everything about it. */
  choose: () => void;
}

/** One robot of the fleet table. */
export function FleetLine({ row, wide, pinned, identify, choose }: Props) {
  const name = words.shortId(row.id);
  const low = row.battery !== null && row.battery < CHARGE_LOW;
  return (
    <tr data-presence={row.presence}>
      <td>
        {row.pixel ?? <span className="quiet">–</span>}
        {pinned ? <IconPinFilled size={12} role="img" aria-label="pinned" /> : null}
      </td>
      <td className="mono">{name}</td>
      <td>{words.stateText(row)}</td>
      <td className={low ? 'low' : undefined}>
        {words.chargeText(row)}
        {low ? <span className="hidden-text"> low</span> : null}
      </td>
      {wide ? (
        <>
          <td>{words.heardText(row)}</td>
          <td>{words.firmwareText(row)}</td>
          <td>{words.abilitiesText(row)}</td>
          <td>{words.clockText(row)}</td>
        </>
      ) : null}
      <td className="row-actions">
        <Tooltip label="Let it blink">
          <ActionIcon
            variant="subtle"
            color="gray"
            size="sm"
            disabled={!row.abilities.blink || row.presence !== 'active'}
            aria-label={`Let robot ${name} blink`}
            onClick={identify}
          >
            <IconBulb size={15} />
          </ActionIcon>
        </Tooltip>
        <Tooltip label="All about it: pin, forget…">
          <ActionIcon
            variant="subtle"
            color="gray"
            size="sm"
            aria-label={`More about robot ${name}`}
            onClick={choose}
          >
            <IconDots size={15} />
          </ActionIcon>
        </Tooltip>
      </td>
    </tr>
  );
}
