import { useEffect, useState } from 'react';
import { makeTemplateFrame, type MadeTemplateFrame } from '../make/templateShow';
import { TEMPLATES } from '../make/templates';
import type { Fleet } from './begin';
import { useMaker } from './useMaker';

/** The frame that each template's card shows, by template id, made one after the other for a fleet. */
export function useFaces({ robots, stage }: Fleet): ReadonlyMap<string, MadeTemplateFrame> {
  // A maker of its own, because a newer request would replace those of another user of the maker.
  const maker = useMaker();
  const [faces, setFaces] = useState<ReadonlyMap<string, MadeTemplateFrame>>(new Map());
  useEffect(() => {
    let isWanted = true;
    const make = async () => {
      for (const { id, face, frames } of TEMPLATES) {
        const wanted = frames(robots)[face];
        if (!wanted) continue;
        const made = await makeTemplateFrame(maker, wanted, robots, stage, 'quick');
        if (!isWanted) return;
        if (made) setFaces((now) => new Map(now).set(id, made));
      }
    };
    void make();
    return () => {
      isWanted = false;
    };
  }, [maker, robots, stage]);
  return faces;
}
