import { FleetSide } from './FleetSide';
import { FrameStrip } from './FrameStrip';
import { LiveStage } from './LiveStage';
import { StartDialog } from './StartDialog';
import { Transport } from './Transport';

/** Watching and playing. */
export function LivePage() {
  return (
    <main className="page">
      <LiveStage />
      <section className="bottom" aria-label="Playing">
        <Transport />
        <FrameStrip />
      </section>
      <FleetSide />
      <StartDialog />
    </main>
  );
}
