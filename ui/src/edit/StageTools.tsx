import {
  IconBarrierBlock,
  IconBucketDroplet,
  IconColorPicker,
  IconGhost2,
  IconHandStop,
  IconLasso,
  IconMagnet,
  IconNumber123,
  IconPencil,
  IconPointer,
  IconRoute,
} from '@tabler/icons-react';
import { useStore } from '../base/store';
import { StageTool, ZoomTools } from '../stage/ViewTools';
import { useEditing } from './context';
import type { StageOptions } from './editing';
import { openDrawing } from './penActs';
import styles from '../stage/stage.module.css';

const TOOLS = [
  ['arrow', 'Select (V)', IconPointer],
  ['hand', 'Move the view (hold Space and drag)', IconHandStop],
  ['lasso', 'Lasso (Q)', IconLasso],
  ['eyedropper', 'Eyedropper (I)', IconColorPicker],
  ['fill', 'Fill with the chosen colour (F): drag to paint', IconBucketDroplet],
  ['area', 'No-go area (O): drag to draw or move, Alt for a circle', IconBarrierBlock],
] as const;

const OPTIONS: [keyof StageOptions, string, typeof IconMagnet][] = [
  ['snap', 'Snap to grid and neighbours (M)', IconMagnet],
  ['ids', 'Show ids (N)', IconNumber123],
  ['ghosts', 'Onion skin (H)', IconGhost2],
  ['routes', 'Show routes (W)', IconRoute],
];

/** Tools and view options of the editor's stage. */
export function StageTools() {
  const editing = useEditing();
  const tool = useStore(editing.tool);
  const options = useStore(editing.options);
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
        <StageTool label="Draw a line (B)" onClick={() => openDrawing(editing)}>
          <IconPencil size={17} />
        </StageTool>
      </div>
      <div className={styles.tools} role="toolbar" aria-label="What the floor shows">
        {OPTIONS.map(([name, label, Icon]) => (
          <StageTool
            key={name}
            label={label}
            active={options[name]}
            onClick={() => editing.options.set({ ...options, [name]: !options[name] })}
          >
            <Icon size={17} />
          </StageTool>
        ))}
        <ZoomTools view={editing.view} />
      </div>
    </>
  );
}
