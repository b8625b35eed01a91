package saker.telemetry;

import java.awt.Color;
import java.awt.Dimension;
import java.awt.Graphics2D;
import java.io.IOException;
import java.util.Map;
import java.util.TreeMap;
import lcm.lcm.LCMDataInputStream;
import lcm.spy.SpyPlugin;
import saker.health_t;
import saker.loop_health_t;

/** A bar a loop of each process: median and 95th percentile of a run against the time from one run to the next. */
public class LoopPlot extends Plot implements SpyPlugin {
  public LoopPlot() {
    super("Loops", health_t.LCM_FINGERPRINT);
  }

  @Override
  String[] channels() {
    return new String[] {"_HEALTH"};
  }

  @Override
  Picture picture(String robot) {
    return new Bars();
  }

  private static class Bars implements Picture {
    private static final int MOST_PROCESSES = 16;
    private static final int ROW = 22, LEFT = 260, RIGHT = 150;
    private static final double LATE = 0.8;  // of its period

    private final Map<String, health_t> processes = new TreeMap<>();

    @Override
    public void hear(String channel, LCMDataInputStream message) throws IOException {
      health_t health = new health_t(message);
      if (processes.size() < MOST_PROCESSES || processes.containsKey(health.process)) processes.put(health.process, health);
    }

    @Override
    public void draw(Graphics2D g, Dimension size) {
      g.setColor(Color.DARK_GRAY);
      g.drawString("median (dark) and p95 (light) of a run, as a share of its period; late runs since the start", 8, 16);
      int y = 2 * ROW;
      for (health_t health : processes.values()) {
        for (loop_health_t loop : health.loops) {
          draw(g, health.process, loop, y, size.width - LEFT - RIGHT);
          y += ROW;
        }
      }
    }

    private static void draw(Graphics2D g, String process, loop_health_t loop, int y, int width) {
      g.setColor(Color.BLACK);
      g.drawString(process + " " + loop.name, 8, y);
      g.drawString(String.format("%.1f ms, %d late", loop.p95_ms, loop.misses), LEFT + width + 8, y);
      double p95 = share(loop.p95_ms, loop.rate_hz), median = share(loop.median_ms, loop.rate_hz);
      g.setColor(p95 < LATE ? new Color(150, 200, 150) : new Color(240, 130, 100));
      g.fillRect(LEFT, y - 12, (int) (width * p95), 14);
      g.setColor(new Color(40, 110, 60));
      g.fillRect(LEFT, y - 12, (int) (width * median), 14);
      g.setColor(Color.GRAY);
      g.drawRect(LEFT, y - 12, width, 14);
    }

    private static double share(float ms, float rate_hz) {
      double share = ms * 1e-3 * rate_hz;
      return Double.isNaN(share) ? 0 : Math.min(1, share);
    }
  }
}
