import { useLayoutEffect, useRef, type ReactNode } from 'react';
import styles from './page.module.css';

/** The section below the stage. It writes its height into `--bottom` of the page, because notices stay above it. */
export function Bottom({ label, children }: { label: string; children: ReactNode }) {
  const section = useRef<HTMLElement>(null);
  useLayoutEffect(() => {
    const element = section.current;
    if (!element) return;
    const { style } = document.documentElement;
    const say = () => style.setProperty('--bottom', `${element.offsetHeight}px`);
    const observer = new ResizeObserver(say);
    observer.observe(element);
    say();
    return () => {
      observer.disconnect();
      style.removeProperty('--bottom');
    };
  }, []);
  return (
    <section className={styles.bottom} aria-label={label} ref={section}>
      {children}
    </section>
  );
}
