import type { ClientRequest, IncomingMessage } from 'node:http';
import react from '@vitejs/plugin-react';
import type { ProxyOptions } from 'vite';
import { defineConfig } from 'vitest/config';

/** Where `npm run dev` finds a running `lightbots run`. */
const server = new URL(process.env.LIGHTBOTS_URL ?? 'http://127.0.0.1:8420').origin;

/**
 * The server answers only requests of its own pages. Pages of this development server become such; requests of others
 * keep their origin and are refused.
 */
const proxy = (ws: boolean): ProxyOptions => ({
  target: server,
  changeOrigin: true,
  ws,
  configure(proxy) {
    const adopt = (out: ClientRequest, { headers }: IncomingMessage) => {
      if (headers.origin === `http://${headers.host}`) out.setHeader('origin', server);
    };
    proxy.on('proxyReq', adopt);
    proxy.on('proxyReqWs', adopt);
  },
});

export default defineConfig({
  plugins: [react()],
  build: { target: 'es2022', chunkSizeWarningLimit: 900 },
  server: {
    proxy: { '/api': proxy(false), '/ws': proxy(true) },
  },
  test: { include: ['src/**/*.test.ts'], environment: 'node' },
});
