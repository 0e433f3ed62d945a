import { useEffect, useState } from 'react';
import { makeTemplateFrame, type MadeTemplateFrame } from '../make/templateShow';
import { wordShow } from '../make/templates';
import type { Fleet } from './begin';
import { useMaker } from './useMaker';

/** A frame made of words, first a quick one and then the full one; null: there are no words, or none is made yet. */
export function useWords(text: string, { robots, stage }: Fleet): MadeTemplateFrame | null {
  // A maker of its own: words that are typed must not wait for the pictures of the templates.
  const maker = useMaker();
  const [made, setMade] = useState<MadeTemplateFrame | null>(null);
  useEffect(() => {
    let isWanted = true;
    const frame = wordShow(text.trim())[0];
    const make = async () => {
      if (!frame || text.trim() === '') return setMade(null);
      for (const quality of ['quick', 'full'] as const) {
        const next = await makeTemplateFrame(maker, frame, robots, stage, quality);
        if (!isWanted) return;
        if (next) setMade(next);
      }
    };
    void make();
    return () => {
      isWanted = false;
    };
  }, [text, maker, robots, stage]);
  return made;
}
