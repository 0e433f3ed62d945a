import type { Broker } from '../api/types.gen';

/** State of the connection to the broker, as text. */
export function brokerText(broker: Broker): string {
  switch (broker.phase) {
    case 'off':
      return 'Disconnected.';
    case 'connecting':
      return `Connecting to ${broker.address}…`;
    case 'connected':
      return `Connected to ${broker.node ?? broker.address}.`;
    case 'retrying':
      return `Not connected, trying again. ${broker.reason ?? ''}`.trim();
  }
}
