// The short way between a slider and the picture, see live.py: values go to the server, and pictures come back,
// without the page's elements having anything to do with it.
"use strict";
window.studioLive = (() => {
  const AGAIN = 500;
  let socket = null, waiting = null, due = 0;

  function open() {
    if (!window.clientId || !studio.state.host) return setTimeout(open, 10);
    socket = new WebSocket(`ws://${location.host}/studio/live?tab=${window.clientId}`);
    socket.binaryType = "arraybuffer";
    socket.onmessage = (event) => {
      const length = new DataView(event.data).getUint32(0), words = new TextDecoder();
      const head = JSON.parse(words.decode(new Uint8Array(event.data, 4, length)));
      try {
        studio.show(words.decode(new Uint8Array(event.data, 4 + length)), head);
      } finally {
        socket.send('"shown"');
      }
    };
    socket.onclose = (event) => {
      socket = null;
      // 4404: the server does not know this tab any more; the page is about to be loaded anew.
      if (event.code !== 4404) setTimeout(open, AGAIN);
    };
    socket.onopen = flush;
  }

  function flush() {
    due = 0;
    if (waiting && socket && socket.readyState === WebSocket.OPEN) {
      socket.send(JSON.stringify(waiting));
      waiting = null;
    }
  }

  // The newest value counts; the last one, of a slider that was let go, is told at once.
  function slide(number, value, letGo) {
    if (waiting && waiting[0] !== number) flush();
    waiting = [number, value, letGo];
    if (letGo) { cancelAnimationFrame(due); flush(); }
    else if (!due) { flush(); due = requestAnimationFrame(flush); }
  }

  open();
  return { slide };
})();
