/**
 * A GIF of `side` × `side` pixels with a picture for each entry of `squares`. Each shows a white bar on black, a
 * quarter as wide and half as high as the picture. The entry is the column of the bar's left edge.
 */
export function gifOf(squares: readonly number[], side = 40): Uint8Array<ArrayBuffer> {
  const u16 = (n: number) => [n & 255, n >> 8];
  // Seven bits a pixel: codes have eight bits as long as the table is cleared often enough.
  const colors = [0, 0, 0, 255, 255, 255, ...Array<number>(126 * 3).fill(0)];
  const bytes = [
    ...new TextEncoder().encode('GIF89a'),
    ...u16(side),
    ...u16(side),
    0xf6,
    0,
    0,
    ...colors,
  ];
  for (const left of squares) {
    const isLit = (n: number) => {
      const [x, y] = [n % side, Math.floor(n / side)];
      return x >= left && x < left + side / 4 && y >= side / 4 && y < (side * 3) / 4;
    };
    const codes: number[] = [];
    for (let n = 0; n < side * side; n++) {
      if (n % 120 === 0) codes.push(128);
      codes.push(isLit(n) ? 1 : 0);
    }
    codes.push(129);
    bytes.push(0x21, 0xf9, 4, 0, ...u16(80), 0, 0, 0x2c, 0, 0, 0, 0, ...u16(side), ...u16(side), 0);
    bytes.push(7);
    for (let at = 0; at < codes.length; at += 255) {
      const block = codes.slice(at, at + 255);
      bytes.push(block.length, ...block);
    }
    bytes.push(0);
  }
  bytes.push(0x3b);
  return new Uint8Array(bytes);
}
