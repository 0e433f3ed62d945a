import { IconCopy, IconPlus, IconTrash } from '@tabler/icons-react';
import type { ReactNode } from 'react';
import { IconButton } from '../parts/IconButton';
import * as acts from './acts';
import { useEditing, useEditor } from './context';

/** Buttons that add, copy and delete frames; `position`: the side on which their tooltips appear. */
export function FrameButtons({ position }: { position: 'right' | 'top' }) {
  const editing = useEditing();
  const isAll = useEditor((s) => s.show.frames.length <= s.frames.size);
  const button = (label: string, act: () => void, icon: ReactNode, off = false) => (
    <IconButton
      label={label}
      position={position}
      variant="default"
      color={undefined}
      size="lg"
      disabled={off}
      onClick={act}
    >
      {icon}
    </IconButton>
  );
  return (
    <>
      {button('Add a frame (Ctrl Enter)', () => acts.addFrame(editing), <IconPlus size={18} />)}
      {button('Duplicate (Ctrl D)', () => acts.duplicateFrames(editing), <IconCopy size={17} />)}
      {button(
        'Delete (Ctrl Delete)',
        () => acts.deleteFrames(editing),
        <IconTrash size={17} />,
        isAll,
      )}
    </>
  );
}
