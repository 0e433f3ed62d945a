import { createTheme, type MantineColorsTuple } from '@mantine/core';

/** Night: blue-grey, so dark that a light on the floor is the brightest thing on screen. */
const night: MantineColorsTuple = [
  '#d5dbe6',
  '#b9c2d1',
  '#9aa5b8',
  '#808ca1',
  '#2d3543',
  '#232a36',
  '#1a202a',
  '#10141b',
  '#0c0f15',
  '#080a0e',
];

/** Lamp: warm amber, for what is chosen and for the one thing to do next. */
const lamp: MantineColorsTuple = [
  '#fff6e5',
  '#fde8c4',
  '#fad69a',
  '#f5c26b',
  '#edb256',
  '#e3a03a',
  '#cc8620',
  '#a86a12',
  '#85520c',
  '#603a07',
];

/** Stop: the only red. */
const stop: MantineColorsTuple = [
  '#ffecec',
  '#fbd0d0',
  '#f4aaaa',
  '#ee8484',
  '#e36666',
  '#d64f50',
  '#bf3b3e',
  '#a83034',
  '#8c2529',
  '#6c1a1e',
];

const onLamp = (name: string, props: { variant?: string; color?: string }) =>
  (props.variant ?? 'filled') === 'filled' && props.color === undefined
    ? { [name]: 'var(--on-lamp)' }
    : {};

export const theme = createTheme({
  colors: { dark: night, lamp, red: stop },
  primaryColor: 'lamp',
  primaryShade: { light: 8, dark: 4 },
  autoContrast: true,
  luminanceThreshold: 0.32,
  defaultRadius: 'md',
  cursorType: 'pointer',
  fontFamily: 'Inter, system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif',
  fontFamilyMonospace: 'ui-monospace, "SF Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace',
  fontSizes: { xs: '0.75rem', sm: '0.8125rem', md: '0.875rem', lg: '1rem', xl: '1.25rem' },
  headings: { fontWeight: '600' },
  respectReducedMotion: true,
  components: {
    // What is written on the lamp's amber: dark on bright amber at night, white on deep amber by day.
    Button: {
      vars: (_: unknown, props: { variant?: string; color?: string }) => ({
        root: onLamp('--button-color', props),
      }),
    },
    Badge: {
      vars: (_: unknown, props: { variant?: string; color?: string }) => ({
        root: onLamp('--badge-color', props),
      }),
    },
    Tooltip: { defaultProps: { openDelay: 450, withArrow: false, fz: 'xs' } },
    Modal: {
      defaultProps: {
        closeButtonProps: { 'aria-label': 'Close' },
        centered: true,
        overlayProps: { backgroundOpacity: 0.6, blur: 2 },
      },
    },
  },
});
