#pragma once

#include <string_view>

namespace mms {

/// Style sheet of the report. Eight colors that color-blind readers can distinguish (after Okabe
/// and Ito), lighter in the dark theme.
inline constexpr std::string_view kReportStyle = R"(
:root{--page:#f6f7f8;--card:#fff;--ink:#1d2329;--dim:#5c6770;--rule:#dfe3e7;
--k0:#0b62a8;--k1:#d9822b;--k2:#0a8f6a;--k3:#b03a6e;--k4:#4fa6d8;--k5:#c9a800;--k6:#7a5ea8;--k7:#444c54;
--good:#2e9e6b;--fair:#e0b020;--poor:#e07b2b;--bad:#cf3b3b;--new:#4f8fd0}
@media(prefers-color-scheme:dark){:root{--page:#14181b;--card:#1d2327;--ink:#e6eaed;--dim:#9aa5ad;--rule:#343c42;
--k0:#58a9ea;--k1:#f0a050;--k2:#3cc79b;--k3:#e27aa9;--k4:#8fd0f5;--k5:#e8cf4a;--k6:#b49be0;--k7:#c6ced4}}
*{box-sizing:border-box}
body{margin:0 auto;padding:24px;max-width:1180px;background:var(--page);color:var(--ink);
font:15px/1.5 system-ui,"Segoe UI",Roboto,"DejaVu Sans",sans-serif}
h1{font-size:26px;margin:0;overflow-wrap:anywhere}h2{font-size:17px;margin:0 0 8px}
.note,figcaption,.sub{color:var(--dim);margin:4px 0 0}
section{background:var(--card);border:1px solid var(--rule);border-radius:8px;padding:16px 20px;margin:16px 0 0}
.pair{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(440px,100%),1fr));gap:0 16px}
table{width:100%;border-collapse:collapse}
tbody{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(310px,100%),1fr));gap:0 36px}
tr{display:flex;justify-content:space-between;gap:12px;border-bottom:1px solid var(--rule)}
th,td{padding:4px 0;font-weight:400;text-align:left}th{color:var(--dim)}
.group{grid-column:1/-1;margin-top:10px;border-bottom-width:2px}.group:first-child{margin-top:0}
.group th{color:var(--ink);font-weight:600}
h3{font-size:15px;margin:10px 0 4px}ul{margin:0;padding-left:20px;overflow-wrap:anywhere}
td{font-variant-numeric:tabular-nums;font-weight:600;white-space:nowrap}
.plain tbody{display:table-row-group}.plain tr{display:table-row}
.plain th,.plain td{padding:4px 12px 4px 0;border-bottom:1px solid var(--rule);text-align:right}
.plain th:first-child,.plain td:first-child{text-align:left}
.plot{display:block;width:100%;height:auto}
.plot text{fill:var(--dim);font-size:12px}
@media(max-width:600px){.plot text{font-size:var(--narrow,25px)}.plot .second{display:none}}
.grid{stroke:var(--rule);stroke-width:1;fill:none}
.line{fill:none;stroke-width:1.6;stroke-linejoin:round;stroke-linecap:round}
.marker{fill:none;stroke-width:10;stroke-linecap:round}
.band{stroke:none;fill-opacity:.75}
.legend{display:flex;flex-wrap:wrap;gap:2px 18px;color:var(--dim);font-size:13px}
.swatch{display:inline-block;width:11px;height:11px;border-radius:2px;margin-right:6px}
.c0{--k:var(--k0)}.c1{--k:var(--k1)}.c2{--k:var(--k2)}.c3{--k:var(--k3)}
.c4{--k:var(--k4)}.c5{--k:var(--k5)}.c6{--k:var(--k6)}.c7{--k:var(--k7)}
.initialized{--k:var(--new)}.tracking{--k:var(--good)}.recovered{--k:var(--fair)}
.degenerate{--k:var(--poor)}.lost{--k:var(--bad)}
.swatch{background:var(--k)}.line,.marker{stroke:var(--k)}.band,rect{fill:var(--k)}
.pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(320px,100%),1fr));gap:16px}
figure{margin:0}img{display:block;max-width:100%;height:auto;border-radius:4px;margin:0 auto}
)";

}  // namespace mms
