import {
  IconBarrierBlock,
  IconColorPicker,
  IconGhost2,
  IconLasso,
  IconMagnet,
  IconNumber123,
  IconPointer,
  IconRoute,
} from '@tabler/icons-react';
import { useStore } from '../base/store';
import { StageTool, ZoomTools } from '../stage/ViewTools';
import { useEditing } from './context';
import type { Looks } from './editing';
import styles from '../stage/stage.module.css';

const TOOLS = [
  ['arrow', 'Choose and move (V)', IconPointer],
  ['lasso', 'Lasso (Q)', IconLasso],
  ['eyedropper', 'Eyedropper (I)', IconColorPicker],
  ['area', 'No-go areas: drag to draw or move one, Alt for a round one (O)', IconBarrierBlock],
] as const;

const LOOKS: [keyof Looks, string, typeof IconMagnet][] = [
  ['snap', 'Snap to grid and neighbours (M)', IconMagnet],
  ['ids', 'Show ids (N)', IconNumber123],
  ['ghosts', 'Frame before and after (H)', IconGhost2],
  ['ways', 'Planned ways (W)', IconRoute],
];

/** Tools and looks of the editor's stage. */
export function StageTools() {
  const editing = useEditing();
  const tool = useStore(editing.tool);
  const looks = useStore(editing.looks);
  return (
    <>
      <div className={styles.tools} data-side="left" role="toolbar" aria-label="Tools">
        {TOOLS.map(([name, label, Icon]) => (
          <StageTool
            key={name}
            label={label}
            active={tool === name}
            onClick={() => editing.tool.set(name)}
          >
            <Icon size={17} />
          </StageTool>
        ))}
      </div>
      <div className={styles.tools} role="toolbar" aria-label="What the floor shows">
        {LOOKS.map(([name, label, Icon]) => (
          <StageTool
            key={name}
            label={label}
            active={looks[name]}
            onClick={() => editing.looks.set({ ...looks, [name]: !looks[name] })}
          >
            <Icon size={17} />
          </StageTool>
        ))}
        <ZoomTools view={editing.view} />
      </div>
    </>
  );
}
