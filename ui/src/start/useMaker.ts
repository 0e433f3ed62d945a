import { useEffect, useState } from 'react';
import { startWorker } from '../make/browserWorker';
import { createMaker, type Maker } from '../make/maker';

/** A maker that is ended when the component is removed. */
export function useMaker(): Maker {
  const [maker] = useState(() => createMaker(startWorker));
  useEffect(() => () => maker.end(), [maker]);
  return maker;
}
