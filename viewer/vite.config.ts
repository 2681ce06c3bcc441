import { loadEnv } from 'vite';
import { defineConfig } from 'vitest/config';

// `npm run dev` shows the page from source beside a running `mms view DIR` (or `mms run --view`).
const { MMS_VIEW: server = 'http://127.0.0.1:8080' } = loadEnv('development', '.', 'MMS_');

export default defineConfig({
  base: './',
  build: {
    target: 'es2020',
    assetsInlineLimit: 0, // everything is a file of its own: the page's CSP allows nothing inline
    modulePreload: false,
    chunkSizeWarningLimit: 1000,
    rollupOptions: {
      output: {
        // No hashes: the committed build changes where its content does, and nowhere else.
        entryFileNames: 'assets/[name].js',
        chunkFileNames: 'assets/[name].js',
        assetFileNames: 'assets/[name][extname]',
        manualChunks: (id) => (id.includes('node_modules/three') ? 'three' : undefined),
      },
    },
  },
  server: {
    proxy: {
      '/ws': { target: server, ws: true, changeOrigin: true, rewriteWsOrigin: true },
      '/files': { target: server, changeOrigin: true },
    },
  },
  test: { include: ['test/unit/**/*.test.ts'] },
});
