import { createTheme, type CSSVariablesResolver, type MantineColorsTuple } from '@mantine/core';

/** Shades of a colour for Mantine, from names of tokens in tokens.css, which differ between the two schemes. */
const shades = (...tokens: string[]) =>
  tokens.map((token) => `var(--${token})`) as unknown as MantineColorsTuple;
const one = (token: string) => shades(...Array<string>(10).fill(token));

/** Mantine's ten shades of `dark`, its surfaces and texts in the dark scheme, from the text to the background. */
const dark = shades(
  'ink',
  'ink',
  'ink-2',
  'ink-3',
  'line',
  'over',
  'raised',
  'panel',
  'ground',
  'ground',
);
/** Mantine's ten shades of `gray`, its surfaces and texts in the light scheme, from the background to the text. */
const gray = shades(
  'over',
  'ground',
  'line',
  'line',
  'edge',
  'ink-3',
  'ink-2',
  'ink-2',
  'ink',
  'ink',
);

/** Tokens that Mantine's variants (filled, light, outline) of a colour are made of. */
interface Tone {
  fill: string;
  hover: string;
  wash: string;
  ink: string;
}

const TONES: Record<string, Tone> = {
  lamp: { fill: '--lamp', hover: '--lamp-hover', wash: '--lamp-wash', ink: '--lamp-ink' },
  gray: { fill: '--ink-2', hover: '--ink', wash: '--over', ink: '--ink' },
  good: { fill: '--good', hover: '--good', wash: '--over', ink: '--good' },
  care: { fill: '--care', hover: '--care', wash: '--care-wash', ink: '--care' },
  bad: { fill: '--bad', hover: '--bad', wash: '--over', ink: '--bad' },
  stop: { fill: '--stop', hover: '--stop-hover', wash: '--over', ink: '--bad' },
};

function variantsOf([name, { fill, hover, wash, ink }]: [string, Tone]): [string, string][] {
  const color = `--mantine-color-${name}`;
  return [
    [`${color}-filled`, `var(${fill})`],
    [`${color}-filled-hover`, `var(${hover})`],
    [`${color}-light`, `var(${wash})`],
    [`${color}-light-hover`, `var(${wash})`],
    [`${color}-light-color`, `var(${ink})`],
    [`${color}-outline`, `var(${ink})`],
    [`${color}-outline-hover`, `var(${wash})`],
    [`${color}-text`, `var(${ink})`],
  ];
}

const SURFACES = {
  '--mantine-color-body': 'var(--panel)',
  '--mantine-color-text': 'var(--ink)',
  '--mantine-color-bright': 'var(--ink)',
  '--mantine-color-dimmed': 'var(--ink-2)',
  '--mantine-color-placeholder': 'var(--ink-3)',
  '--mantine-color-error': 'var(--bad)',
  '--mantine-color-anchor': 'var(--ink)',
  '--mantine-color-default': 'var(--raised)',
  '--mantine-color-default-hover': 'var(--over)',
  '--mantine-color-default-color': 'var(--ink)',
  '--mantine-color-default-border': 'var(--edge)',
  '--mantine-color-disabled': 'var(--over)',
  '--mantine-color-disabled-color': 'var(--ink-3)',
  '--mantine-color-disabled-border': 'var(--line)',
};

/** Mantine's variables, the same for both schemes, because the tokens differ between them. */
export const mantineVariables: CSSVariablesResolver = () => {
  const colours = { ...SURFACES, ...Object.fromEntries(Object.entries(TONES).flatMap(variantsOf)) };
  return { variables: {}, dark: colours, light: colours };
};

interface Filled {
  variant?: string;
  color?: string;
}

/** Colour of text on filled buttons or badges, by the fill: lamp and stop have their own, others that of the panel. */
const onFill =
  (part: 'button' | 'badge') =>
  (_: unknown, { variant = 'filled', color = 'lamp' }: Filled) => {
    const text = { lamp: 'var(--on-lamp)', stop: 'var(--on-stop)' }[color] ?? 'var(--panel)';
    const border = color === 'lamp' ? { [`--${part}-bd`]: '1px solid var(--lamp-edge)' } : {};
    return { root: variant === 'filled' ? { [`--${part}-color`]: text, ...border } : {} };
  };

export const theme = createTheme({
  colors: {
    dark,
    gray,
    lamp: one('lamp'),
    good: one('good'),
    care: one('care'),
    bad: one('bad'),
    stop: one('stop'),
  },
  primaryColor: 'lamp',
  defaultRadius: 'md',
  cursorType: 'pointer',
  fontFamily: 'var(--font)',
  fontFamilyMonospace: 'var(--mono)',
  fontSizes: {
    xs: 'var(--t1)',
    sm: 'var(--t2)',
    md: 'var(--t3)',
    lg: 'var(--t4)',
    xl: 'var(--t5)',
  },
  radius: {
    xs: 'var(--r1)',
    sm: 'var(--r1)',
    md: 'var(--r2)',
    lg: 'var(--r3)',
    xl: 'var(--r4)',
  },
  headings: { fontWeight: 'var(--w-title)' },
  focusRing: 'never',
  respectReducedMotion: true,
  components: {
    Button: { vars: onFill('button') },
    Badge: { vars: onFill('badge') },
    Slider: { defaultProps: { color: 'gray' } },
    Checkbox: { defaultProps: { color: 'var(--ink)', iconColor: 'var(--panel)' } },
    Tooltip: {
      defaultProps: { openDelay: 450, withArrow: false, fz: 'xs' },
      vars: () => ({
        tooltip: { '--tooltip-bg': 'var(--ink)', '--tooltip-color': 'var(--panel)' },
      }),
    },
    Modal: {
      defaultProps: {
        radius: 'xl',
        closeButtonProps: { 'aria-label': 'Close' },
        centered: true,
        overlayProps: { color: 'var(--veil)', backgroundOpacity: 1, blur: 2 },
      },
    },
  },
});
