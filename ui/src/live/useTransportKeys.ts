import { useKeys } from '../parts/useKeys';
import { useStore } from '../base/store';
import { useSession } from '../session/session';
import type { Action } from './actions';

/** The keys of the live view for playing and for choosing frames. `main`: what Space does. */
export function useTransportKeys(perform: (action: Action) => void, main: Action) {
  const { live, frame, checking } = useSession();
  const last = useStore(live.opened, (o) => (o.show?.frames.length ?? 1) - 1);
  const step = (by: number) => frame.update((now) => Math.max(0, Math.min(last, now + by)));
  useKeys([
    ['space', () => perform(main)],
    ['s', () => perform('step')],
    ['p', () => perform('preview')],
    ['j', () => perform('jump')],
    ['n', () => perform('skip')],
    ['Enter', () => perform('go')],
    ['PageDown', () => perform('go')],
    ['l', () => perform('loop')],
    ['c', () => checking.set(true)],
    ['r', () => perform('refresh')],
    ['Escape', () => perform('abort')],
    ['ArrowLeft', () => step(-1)],
    ['ArrowRight', () => step(1)],
    ['Home', () => frame.set(0)],
    ['End', () => frame.set(Math.max(0, last))],
  ]);
}
